#include "render/verify/frame_images.h"

#include <fmt/format.h>

#include <array>

namespace dollytrack::verify {
namespace {

using Type = ImageKind::Type;

constexpr std::array kKinds = {
    ImageKind{"rgb", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"depth", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"instance", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"semantic", ".png", Type::Bits8, 1, nullptr},
    ImageKind{"depth_exr", ".exr", Type::Float, 1, nullptr},
    ImageKind{"normal_camera", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"normal_world", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"albedo", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"object_coordinates", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"rgb_right", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"depth_right", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"disparity", ".png", Type::Bits16, 1, "_mask.png"},
};

template <class T>
std::string sizeProblem(const Result<Image<T>>& image, const Intrinsics& lens) {
    if (!image) return image.error().message;
    if (image->width == lens.width && image->height == lens.height) return {};
    return fmt::format("it is {} x {} px where {} x {} are said", image->width, image->height,
                       lens.width, lens.height);
}

/// Keeps the image when it can be used, else says why not.
template <class T>
std::string take(Result<Image<T>> read, const Intrinsics& lens, Image<T>& image) {
    std::string problem = sizeProblem(read, lens);
    if (problem.empty()) image = std::move(*read);
    return problem;
}

}  // namespace

std::span<const ImageKind> imageKinds() {
    return kKinds;
}

const ImageKind* imageKind(std::string_view modality) {
    for (const ImageKind& kind : kKinds) {
        if (modality == kind.modality) return &kind;
    }
    return nullptr;
}

std::string imageFile(const ImageKind& kind, int frame) {
    return fmt::format("{}/{:06}{}", kind.modality, frame, kind.extension);
}

std::string imageFile(std::string_view modality, int frame) {
    const ImageKind* kind = imageKind(modality);
    return kind ? imageFile(*kind, frame) : fmt::format("{}/{:06}", modality, frame);
}

const FrameImages::Entry& FrameImages::load(std::string_view modality) {
    if (const auto at = entries_.find(modality); at != entries_.end()) return at->second;
    Entry& entry = entries_[std::string(modality)];
    const ImageKind* kind = imageKind(modality);
    if (!kind || !dataset_.has(modality)) {
        entry.problem = "the dataset has none";
        return entry;
    }
    const std::filesystem::path path = dataset_.folder / imageFile(*kind, frame_);
    const Intrinsics& lens = dataset_.lens;
    switch (kind->type) {
        case Type::Bits8:
            entry.problem = take(readImage8(path, kind->channels), lens, entry.bits8);
            break;
        case Type::Bits16:
            entry.problem = take(readImage16(path, kind->channels), lens, entry.bits16);
            break;
        case Type::Float:
            entry.problem = take(readImageF(path, kind->channels), lens, entry.real);
            break;
    }
    return entry;
}

const FrameImages::Entry& FrameImages::loadMask(std::string_view modality) {
    if (const auto at = masks_.find(modality); at != masks_.end()) return at->second;
    Entry& entry = masks_[std::string(modality)];
    const ImageKind* kind = imageKind(modality);
    if (!kind || !kind->mask || !dataset_.has(modality)) {
        entry.problem = "the dataset has none";
        return entry;
    }
    const std::string file = fmt::format("{}/{:06}{}", modality, frame_, kind->mask);
    entry.problem = take(readImage8(dataset_.folder / file, 1), dataset_.lens, entry.bits8);
    return entry;
}

const Image8* FrameImages::image8(std::string_view modality) {
    const Entry& entry = load(modality);
    return entry.problem.empty() ? &entry.bits8 : nullptr;
}

const Image16* FrameImages::image16(std::string_view modality) {
    const Entry& entry = load(modality);
    return entry.problem.empty() ? &entry.bits16 : nullptr;
}

const ImageF* FrameImages::imageF(std::string_view modality) {
    const Entry& entry = load(modality);
    return entry.problem.empty() ? &entry.real : nullptr;
}

const Image8* FrameImages::mask(std::string_view modality) {
    const Entry& entry = loadMask(modality);
    return entry.problem.empty() ? &entry.bits8 : nullptr;
}

std::string FrameImages::problem(std::string_view modality) {
    return load(modality).problem;
}

std::string FrameImages::maskProblem(std::string_view modality) {
    return loadMask(modality).problem;
}

const FrameImages::Depth* FrameImages::depth() {
    if (depth_) return depth_->metres.values.empty() ? nullptr : depth_.get();
    depth_ = std::make_unique<Depth>();
    if (const ImageF* exact = imageF("depth_exr")) {
        depth_->metres = *exact;
        depth_->rounding_m = 1e-6;
    } else if (const Image16* rounded = image16("depth")) {
        depth_->metres = {rounded->width, rounded->height, 1, {}};
        depth_->metres.values.reserve(rounded->values.size());
        for (const std::uint16_t value : rounded->values) {
            depth_->metres.values.push_back(static_cast<float>(value * 0.001));
        }
        depth_->rounding_m = 0.0005 + 1e-6;
    }
    return depth();
}

FrameImages& FrameImages::other(int frame) {
    if (frame == frame_) return *this;
    std::unique_ptr<FrameImages>& at = others_[frame];
    if (!at) at = std::make_unique<FrameImages>(dataset_, frame);
    return *at;
}

}  // namespace dollytrack::verify
