#include "engine/io/pictures/picture_decoder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdlib>
#include <random>
#include <string>

namespace dollytrack::picture_decoder_test {
namespace {

/// An image with smooth colours in OpenCV's layout (BGR, BGRA or grey).
cv::Mat gradient(int width, int height, int type) {
    cv::Mat image(height, width, type);
    const int channels = image.channels();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const int value = (x * (c + 2) + y * 3 + 40 * c) % 256;
                if (image.depth() == CV_16U) {
                    image.ptr<std::uint16_t>(y)[x * channels + c] =
                        static_cast<std::uint16_t>(value * 257);
                } else {
                    image.ptr<std::uint8_t>(y)[x * channels + c] = static_cast<std::uint8_t>(value);
                }
            }
        }
    }
    return image;
}

std::vector<std::uint8_t> encoded(const char* extension, const cv::Mat& image) {
    std::vector<std::uint8_t> bytes;
    EXPECT_TRUE(cv::imencode(extension, image, bytes));
    return bytes;
}

/// The largest difference from the image decoded by OpenCV, including alpha.
int differenceFromOpenCv(const std::vector<std::uint8_t>& bytes, const Texture& texture) {
    const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (image.cols != texture.width || image.rows != texture.height) return 256;
    int worst = 0;
    const int channels = image.channels();
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
            const std::uint8_t* ours =
                texture.rgba.data() + 4 * (static_cast<std::size_t>(y) * image.cols + x);
            for (int c = 0; c < 4; ++c) {
                int theirs = 255;
                const int from = channels < 3 ? 0 : c < 3 ? 2 - c : 3;
                if (c < 3 || channels == 4) {
                    theirs = image.depth() == CV_16U
                                 ? image.ptr<std::uint16_t>(y)[x * channels + from] / 257
                                 : image.ptr<std::uint8_t>(y)[x * channels + from];
                }
                worst = std::max(worst, std::abs(theirs - ours[c]));
            }
        }
    }
    return worst;
}

TEST(PictureDecoder, AgreesWithOpenCv) {
    struct Case {
        const char* extension;
        int type;
        int most;  // difference
    };
    for (const Case& one :
         {Case{".png", CV_8UC3, 0}, Case{".png", CV_8UC4, 0}, Case{".png", CV_8UC1, 0},
          Case{".png", CV_16UC3, 0}, Case{".png", CV_16UC1, 0}, Case{".jpg", CV_8UC3, 0},
          Case{".jpg", CV_8UC1, 0}, Case{".bmp", CV_8UC3, 0}, Case{".tiff", CV_8UC3, 0},
          Case{".tiff", CV_8UC4, 0}, Case{".webp", CV_8UC3, 0}, Case{".ppm", CV_8UC3, 0}}) {
        const auto bytes = encoded(one.extension, gradient(37, 23, one.type));
        Texture texture;
        ASSERT_TRUE(decodePicture(bytes, 1024, false, texture)) << one.extension << one.type;
        EXPECT_LE(differenceFromOpenCv(bytes, texture), one.most) << one.extension << one.type;
    }
}

TEST(PictureDecoder, MakesLargePicturesSmallerAndOpaqueOnesWhole) {
    const auto bytes = encoded(".png", cv::Mat(100, 400, CV_8UC4, cv::Scalar(10, 20, 30, 40)));
    Texture texture;
    ASSERT_TRUE(decodePicture(bytes, 200, true, texture));
    EXPECT_EQ(texture.width, 200);
    EXPECT_EQ(texture.height, 50);
    EXPECT_EQ((std::vector<std::uint8_t>(texture.rgba.begin(), texture.rgba.begin() + 4)),
              (std::vector<std::uint8_t>{30, 20, 10, 255}));
}

TEST(PictureDecoder, RefusesWhatIsTooLargeOrCutOff) {
    auto bytes = encoded(".png", gradient(16, 16, CV_8UC3));
    Texture texture;
    EXPECT_FALSE(decodePicture({}, 1024, false, texture));
    for (const std::size_t size : {4U, 20U, 40U, 60U}) {
        EXPECT_FALSE(decodePicture(std::span(bytes).first(size), 1024, false, texture));
    }
    bytes[16] = 0x7F;  // the width's first byte: 2^30 and more
    EXPECT_FALSE(decodePicture(bytes, 1024, false, texture));
    EXPECT_TRUE(texture.rgba.empty());
}

// Third-party decoders read damaged bytes; they must end, with or without an image.
TEST(PictureDecoder, OutlivesDamage) {
    std::mt19937 random(5);
    for (const char* extension : {".png", ".jpg", ".bmp", ".tiff", ".webp", ".ppm"}) {
        const auto whole = encoded(extension, gradient(37, 23, CV_8UC3));
        for (int i = 0; i < 300; ++i) {
            auto bytes = whole;
            for (int k = 0; k < 3; ++k) {
                bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
            }
            if (i % 3 == 0) bytes.resize(random() % bytes.size());
            Texture texture;
            if (!decodePicture(bytes, 64, false, texture)) continue;
            ASSERT_EQ(texture.rgba.size(), 4U * static_cast<unsigned>(texture.width) *
                                               static_cast<unsigned>(texture.height));
            ASSERT_LE(std::max(texture.width, texture.height), 64);
        }
    }
}

// stb_image does not end at an HDR file that ends within a run.
TEST(PictureDecoder, RefusesHdrFilesThatAreCut) {
    cv::Mat image;
    gradient(16, 16, CV_8UC3).convertTo(image, CV_32FC3, 1.0 / 255.0);
    const auto whole = encoded(".hdr", image);
    Texture texture;
    ASSERT_TRUE(decodePicture(whole, 1024, false, texture));
    EXPECT_EQ(texture.width, 16);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(decodePicture(std::span(whole).first(size), 1024, false, texture)) << size;
    }
    // A line that stb_image ends earlier than its line break.
    auto zero = whole;
    zero[2] = 0;
    EXPECT_FALSE(decodePicture(zero, 1024, false, texture));
}

}  // namespace
}  // namespace dollytrack::picture_decoder_test
