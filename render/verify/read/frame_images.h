#pragma once

#include "render/verify/read/image_files.h"
#include "render/verify/read/object_pixels.h"
#include "render/verify/read/stored_dataset.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::verify {

/// File type of a modality's images.
struct ImageKind {
    enum class Type { Bits8, Bits16, Float, Classes };
    const char* modality;   // also the folder
    const char* extension;  // for example ".png"
    Type type;
    int channels;
    const char* mask;  // ending of the 8-bit mask beside each image; null: none
};

/// All modalities with one image per frame, named by frame number.
std::span<const ImageKind> imageKinds();
const ImageKind* imageKind(std::string_view modality);

/// Whether `millimetres` is the correct rounding of the exact depth `metres`. No surface is 0 in
/// both; depths beyond 65.535 m must be stored as 0.
bool isRounded(double metres, std::uint16_t millimetres);

/// Path of an image, for example "depth/000012.png".
std::string imageFile(const ImageKind& kind, int frame);
std::string imageFile(std::string_view modality, int frame);

/// The images of one frame, read on first use. For one thread.
class FrameImages {
  public:
    FrameImages(const StoredDataset& dataset, int frame) : dataset_(dataset), frame_(frame) {}

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] const StoredFrame& stored() const { return dataset_.frames[frame_]; }

    /// The image; null if the dataset lacks the modality, the file is unreadable, or its size or
    /// type is wrong. Only the check `images` reports these problems.
    [[nodiscard]] const Image8* image8(std::string_view modality);
    [[nodiscard]] const Image16* image16(std::string_view modality);
    [[nodiscard]] const ImageF* imageF(std::string_view modality);
    /// Class ids, whether stored in 8 or 16 bits.
    [[nodiscard]] const Image16* classes() { return image16("semantic"); }
    /// Pixels of each object in the instance image, by id; empty without that image.
    [[nodiscard]] const std::map<int, ObjectPixels>& seen();
    /// The mask beside a modality's image.
    [[nodiscard]] const Image8* mask(std::string_view modality);

    /// Problem with an image file; empty if none.
    [[nodiscard]] std::string problem(std::string_view modality);
    [[nodiscard]] std::string maskProblem(std::string_view modality);

    /// Planar depth, m, 0: no surface; exact if the dataset has depth_exr, else in millimetres.
    /// Null if unavailable. `rounding_m` is the largest rounding error.
    struct Depth {
        ImageF metres;
        double rounding_m = 0.0;
        const char* modality = "depth";  // source of the depth
    };
    [[nodiscard]] const Depth* depth();
    /// All depths to check: depth() and, if the dataset also has millimetres that are not its
    /// rounded values, these too.
    [[nodiscard]] std::vector<const Depth*> depths();

    /// The images of another frame of the same dataset.
    [[nodiscard]] FrameImages& other(int frame);

  private:
    struct Entry {
        Image8 bits8;
        Image16 bits16;
        ImageF real;
        std::string problem;
    };
    const Entry& load(std::string_view modality);
    const Entry& loadMask(std::string_view modality);

    const StoredDataset& dataset_;
    int frame_ = 0;
    std::map<std::string, Entry, std::less<>> entries_;
    std::map<std::string, Entry, std::less<>> masks_;
    std::unique_ptr<Depth> depth_;
    std::optional<std::map<int, ObjectPixels>> seen_;
    std::unique_ptr<Depth> other_depth_;
    std::map<int, std::unique_ptr<FrameImages>> others_;
};

}  // namespace dollytrack::verify
