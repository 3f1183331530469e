#include "render/verify/check/check_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::array kUnusableKinds = {"dark", "white", "flat"};

/// Luma of the pixels, row 0 at the top.
std::vector<int> lumasOf(const Image8& picture) {
    std::vector<int> lumas;
    lumas.reserve(static_cast<std::size_t>(picture.width) * picture.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::uint8_t* rgb = picture.pixel(x, y);
            lumas.push_back((54 * rgb[0] + 183 * rgb[1] + 19 * rgb[2] + 128) / 256);
        }
    }
    return lumas;
}

/// Whether too few pairs of neighbouring tiles differ.
bool isFlat(const std::vector<int>& lumas, int width, int height) {
    constexpr int kTile = 8;
    const int across = width / kTile;
    const int down = height / kTile;
    const auto meanAt = [&](int column, int row) {
        double sum = 0.0;
        for (int y = row * kTile; y < (row + 1) * kTile; ++y) {
            for (int x = column * kTile; x < (column + 1) * kTile; ++x) {
                sum += lumas[static_cast<std::size_t>(y) * width + x];
            }
        }
        return sum / (kTile * kTile);
    };
    std::size_t pairs = 0;
    std::size_t alike = 0;
    const auto compare = [&](double a, double b) {
        ++pairs;
        alike += std::abs(a - b) < 5.0 ? 1 : 0;
    };
    for (int row = 0; row < down; ++row) {
        for (int column = 0; column < across; ++column) {
            const double mean = meanAt(column, row);
            if (column + 1 < across) compare(mean, meanAt(column + 1, row));
            if (row + 1 < down) compare(mean, meanAt(column, row + 1));
        }
    }
    return 200 * (pairs - alike) < pairs;
}

/// "usable", "dark", "white" or "flat" by the definition in picture_quality.h. Implemented
/// independently of that file, which computes the values checked here.
std::string qualityOf(const Image8& picture) {
    std::vector<int> lumas = lumasOf(picture);
    if (lumas.empty()) return "usable";
    const auto below = [&](int limit) {
        return std::count_if(lumas.begin(), lumas.end(), [&](int luma) { return luma < limit; });
    };
    const auto all = static_cast<std::ptrdiff_t>(lumas.size());
    if (below(32) * 20 >= all * 19) return "dark";
    if ((all - below(244)) * 20 >= all * 19) return "white";
    return isFlat(lumas, picture.width, picture.height) ? "flat" : "usable";
}

/// By frame: its quality in dataset.json. A frame in two lists gets an invalid name.
std::vector<std::string> readLists(const StoredDataset& dataset, Findings& findings) {
    std::vector<std::string> listed(dataset.frames.size());
    const OrderedJson& pictures = dataset.card.at("metrics").at("pictures");
    const auto differs = [&](const std::string& what, const OrderedJson& found,
                             const OrderedJson& expected) {
        findings.add({"dataset.json",
                      {},
                      {},
                      "metrics.pictures: " + what + " " + found.dump(),
                      expected.dump()});
    };
    const auto frames = static_cast<int>(dataset.frames.size());
    if (pictures.at("measured") != frames) differs("measured", pictures["measured"], frames);
    for (const char* kind : kUnusableKinds) {
        const auto list = pictures.at(kind).get<std::vector<int>>();
        for (const int frame : list) {
            if (frame < 0 || frame >= frames) {
                differs(kind, frame, "a frame of the dataset");
            } else {
                listed[frame] += kind;
            }
        }
        const std::string name = std::string(kind) + "_rate";
        const double rate = static_cast<double>(list.size()) / std::max(frames, 1);
        const OrderedJson& given = pictures.at(name);
        if (!given.is_number() || std::abs(given.get<double>() - rate) > 1e-9) {
            differs(name, given, rate);
        }
    }
    for (std::string& quality : listed) {
        if (quality.empty()) quality = "usable";
    }
    return listed;
}

}  // namespace

CheckWork beginUsable(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    if (!dataset.card.at("metrics").contains("pictures")) return {};  // an older dataset
    const auto listed =
        std::make_shared<const std::vector<std::string>>(readLists(dataset, findings));
    CheckWork work;
    work.frame = [listed](FrameImages& images, Findings& found) {
        const Image8* picture = images.image8("rgb");
        if (!picture) return;
        const std::string quality = qualityOf(*picture);
        const std::string& expected = (*listed)[images.frame()];
        if (quality == expected) return;
        found.add({imageFile("rgb", images.frame()),
                   images.frame(),
                   {},
                   "the image is " + quality,
                   expected + ", as dataset.json lists it"});
    };
    return work;
}

}  // namespace dollytrack::verify
