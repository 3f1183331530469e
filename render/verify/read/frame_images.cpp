#include "render/verify/read/frame_images.h"

#include "render/verify/read/sensor_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::verify {
namespace {

using Type = ImageKind::Type;

constexpr std::array kImageKinds = {
    ImageKind{"rgb", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"depth", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"instance", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"semantic", ".png", Type::Classes, 1, nullptr},
    ImageKind{"depth_exr", ".exr", Type::Float, 1, nullptr},
    ImageKind{"normal_camera", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"normal_world", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"albedo", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"roughness", ".png", Type::Bits8, 1, nullptr},
    ImageKind{"metallic", ".png", Type::Bits8, 1, nullptr},
    ImageKind{"object_coordinates", ".png", Type::Bits16, 3, nullptr},
    ImageKind{"rgb_right", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"depth_right", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"disparity", ".png", Type::Bits16, 1, "_mask.png"},
    ImageKind{"rgb_sensor", ".png", Type::Bits8, 3, nullptr},
    ImageKind{"depth_sensor", ".png", Type::Bits16, 1, nullptr},
    ImageKind{"hdr", ".exr", Type::Float, 3, nullptr},
    ImageKind{"diffuse_reflectance", ".exr", Type::Float, 3, nullptr},
    ImageKind{"diffuse_illumination", ".exr", Type::Float, 3, nullptr},
    ImageKind{"direct_illumination", ".exr", Type::Float, 3, nullptr},
    ImageKind{"indirect_illumination", ".exr", Type::Float, 3, nullptr},
    ImageKind{"residual", ".exr", Type::Float, 3, nullptr},
};

template <class T>
std::string sizeProblem(const Result<Image<T>>& image, const Intrinsics& lens) {
    if (!image) return image.error().message;
    if (image->width == lens.width && image->height == lens.height) return {};
    return fmt::format("it is {} x {} px, expected {} x {}", image->width, image->height,
                       lens.width, lens.height);
}

/// Stores the image if it is usable; else returns the problem.
template <class T>
std::string take(Result<Image<T>> read, const Intrinsics& lens, Image<T>& image) {
    std::string problem = sizeProblem(read, lens);
    if (problem.empty()) image = std::move(*read);
    return problem;
}

FrameImages::Depth fromMillimetres(const Image16& image) {
    FrameImages::Depth depth{{image.width, image.height, 1, {}}, 0.0005 + 1e-6, "depth"};
    depth.metres.values.reserve(image.values.size());
    for (const std::uint16_t value : image.values) {
        depth.metres.values.push_back(static_cast<float>(value * 0.001));
    }
    return depth;
}

}  // namespace

bool isRounded(double metres, std::uint16_t millimetres) {
    if (metres == 0.0) return millimetres == 0;
    const double expected = metres > 65.5355 ? 0.0 : 1000.0 * metres;
    return std::abs(millimetres - expected) <= 0.5 + 1e-3;
}

std::span<const ImageKind> imageKinds() {
    return kImageKinds;
}

const ImageKind* imageKind(std::string_view modality) {
    for (const ImageKind& kind : kImageKinds) {
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
        entry.problem = "the dataset does not have it";
        return entry;
    }
    const std::filesystem::path path = dataset_.folder / storedFile(dataset_, *kind, frame_);
    const Intrinsics& lens = dataset_.lens;
    switch (kind->type) {
        case Type::Bits8:
            entry.problem = take(readImage8(path, kind->channels), lens, entry.bits8);
            break;
        case Type::Bits16:
            entry.problem = take(readImage16(path, kind->channels), lens, entry.bits16);
            break;
        case Type::Classes:
            entry.problem =
                take(readClasses(path, dataset_.classes().isWide()), lens, entry.bits16);
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
        entry.problem = "the dataset does not have it";
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

const std::map<int, ObjectPixels>& FrameImages::seen() {
    if (!seen_) {
        const Image16* ids = image16("instance");
        seen_ = ids ? objectPixels(*ids) : std::map<int, ObjectPixels>{};
    }
    return *seen_;
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
        *depth_ = {*exact, 1e-6, "depth_exr"};
    } else if (const Image16* rounded = image16("depth")) {
        *depth_ = fromMillimetres(*rounded);
    }
    return depth();
}

std::vector<const FrameImages::Depth*> FrameImages::depths() {
    std::vector<const Depth*> all;
    if (depth()) all.push_back(depth());
    const ImageF* exact = imageF("depth_exr");
    const Image16* rounded = image16("depth");
    if (!exact || !rounded) return all;
    if (!other_depth_) {
        const bool same = std::equal(exact->values.begin(), exact->values.end(),
                                     rounded->values.begin(), rounded->values.end(), isRounded);
        other_depth_ = std::make_unique<Depth>();
        if (!same) *other_depth_ = fromMillimetres(*rounded);
    }
    if (!other_depth_->metres.values.empty()) all.push_back(other_depth_.get());
    return all;
}

FrameImages& FrameImages::other(int frame) {
    if (frame == frame_) return *this;
    std::unique_ptr<FrameImages>& at = others_[frame];
    if (!at) at = std::make_unique<FrameImages>(dataset_, frame);
    return *at;
}

}  // namespace dollytrack::verify
