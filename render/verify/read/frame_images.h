#pragma once

#include "render/verify/object_pixels.h"
#include "render/verify/read/image_files.h"
#include "render/verify/read/stored_dataset.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::verify {

/// How a modality's images of every frame are written: what their readers rely on.
struct ImageKind {
    enum class Type { Bits8, Bits16, Float, Classes };
    const char* modality;   // and its folder
    const char* extension;  // ".png"
    Type type;
    int channels;
    const char* mask;  // ending of the 8-bit image that lies beside each; null: none
};

/// All modalities that have one image a frame under its number.
std::span<const ImageKind> imageKinds();
const ImageKind* imageKind(std::string_view modality);

/// Whether an image in millimetres may have this for an exact depth; 0 is none, and beyond what the
/// image can hold.
bool isRounded(double metres, std::uint16_t millimetres);

/// "depth/000012.png"
std::string imageFile(const ImageKind& kind, int frame);
std::string imageFile(std::string_view modality, int frame);

/// The images of one frame, each read when it is first asked for. Of one thread.
class FrameImages {
  public:
    FrameImages(const StoredDataset& dataset, int frame) : dataset_(dataset), frame_(frame) {}

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] const StoredFrame& stored() const {
        return dataset_.frames[static_cast<std::size_t>(frame_)];
    }

    /// The image; null when the dataset has no such images, or this one cannot be read or has
    /// another size or type than is said, which is the business of one check alone.
    [[nodiscard]] const Image8* image8(std::string_view modality);
    [[nodiscard]] const Image16* image16(std::string_view modality);
    [[nodiscard]] const ImageF* imageF(std::string_view modality);
    /// The ids of the classes, whether the dataset has them in 8 bits or in 16.
    [[nodiscard]] const Image16* classes() { return image16("semantic"); }
    /// What the instance image shows of each object, by id; of none when there is no such image.
    [[nodiscard]] const std::map<int, ObjectPixels>& seen();
    /// The mask beside it.
    [[nodiscard]] const Image8* mask(std::string_view modality);

    /// What is wrong with the file; empty when nothing is.
    [[nodiscard]] std::string problem(std::string_view modality);
    [[nodiscard]] std::string maskProblem(std::string_view modality);

    /// Planar depth, m, 0 for none: exact where the dataset has it so, else in millimetres. Null as
    /// above. `rounding` is the most it may be off.
    struct Depth {
        ImageF metres;
        double rounding_m = 0.0;
        const char* modality = "depth";  // whose images it is from
    };
    [[nodiscard]] const Depth* depth();
    /// Each depth that there is to look at: the above and, where millimetres beside exact depth are
    /// not that depth rounded, these as well.
    [[nodiscard]] std::vector<const Depth*> depths();

    /// Another frame of the same dataset.
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
