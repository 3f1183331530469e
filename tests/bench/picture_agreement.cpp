// How similar the images of two datasets are: rasterized and path traced images of the same frames.
//
// Usage: picture_agreement DATASET REFERENCE [SIDE_BY_SIDE.png]
//
// For each frame and in the mean: SSIM of the luma (Wang et al. 2004: 11 x 11 Gaussian of 1.5 px),
// and on the scale 0..255 the mean absolute difference and how much brighter the first image is.

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace {

namespace fs = std::filesystem;

double ssim(const cv::Mat& a, const cv::Mat& b) {
    const auto blurred = [](const cv::Mat& image) {
        cv::Mat result;
        cv::GaussianBlur(image, result, {11, 11}, 1.5);
        return result;
    };
    const double c1 = 0.01 * 0.01 * 255 * 255;
    const double c2 = 0.03 * 0.03 * 255 * 255;
    const cv::Mat mean_a = blurred(a);
    const cv::Mat mean_b = blurred(b);
    const cv::Mat ab = mean_a.mul(mean_b);
    const cv::Mat aa = mean_a.mul(mean_a);
    const cv::Mat bb = mean_b.mul(mean_b);
    const cv::Mat var_a = blurred(a.mul(a)) - aa;
    const cv::Mat var_b = blurred(b.mul(b)) - bb;
    const cv::Mat covariance = blurred(a.mul(b)) - ab;
    const cv::Mat above = (2.0 * ab + c1).mul(2.0 * covariance + c2);
    const cv::Mat below = (aa + bb + c1).mul(var_a + var_b + c2);
    cv::Mat map;
    cv::divide(above, below, map);
    return cv::mean(map)[0];
}

cv::Mat luma(const cv::Mat& bgr) {
    cv::Mat grey;
    cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(grey, CV_64F);
    return grey;
}

double mean(const cv::Mat& image) {
    const cv::Scalar sums = cv::mean(image);
    return (sums[0] + sums[1] + sums[2]) / 3.0;
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::fprintf(stderr, "usage: picture_agreement DATASET REFERENCE [SIDE_BY_SIDE.png]\n");
        return 2;
    }
    std::vector<fs::path> names;
    for (const auto& entry : fs::directory_iterator(fs::path(arguments[1]) / "rgb")) {
        if (fs::exists(fs::path(arguments[2]) / "rgb" / entry.path().filename())) {
            names.push_back(entry.path().filename());
        }
    }
    std::sort(names.begin(), names.end());
    double sums[3] = {};
    std::vector<cv::Mat> rows;
    for (const fs::path& name : names) {
        const cv::Mat a = cv::imread((fs::path(arguments[1]) / "rgb" / name).string());
        const cv::Mat b = cv::imread((fs::path(arguments[2]) / "rgb" / name).string());
        if (a.empty() || a.size() != b.size()) {
            std::fprintf(stderr, "%s: not the same size in both\n", name.c_str());
            return 4;
        }
        cv::Mat difference;
        cv::absdiff(a, b, difference);
        const double found[3] = {ssim(luma(a), luma(b)), mean(difference), mean(a) - mean(b)};
        std::printf("%s  SSIM %.3f  difference %5.1f  brighter by %+6.1f\n", name.c_str(), found[0],
                    found[1], found[2]);
        for (int i = 0; i < 3; ++i) sums[i] += found[i];
        cv::Mat row;
        cv::hconcat(a, b, row);
        rows.push_back(row);
    }
    if (names.empty()) {
        std::fprintf(stderr, "no frame is in both\n");
        return 4;
    }
    const auto n = static_cast<double>(names.size());
    std::printf("mean        SSIM %.3f  difference %5.1f  brighter by %+6.1f\n", sums[0] / n,
                sums[1] / n, sums[2] / n);
    if (count > 3) {
        cv::Mat sheet;
        cv::vconcat(rows, sheet);
        cv::imwrite(arguments[3], sheet);
    }
    return 0;
}
