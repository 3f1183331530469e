#include "engine/io/files/png_writer.h"
#include "render/plots/canvas.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace dollytrack::render {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontHeight = 30.0;  // height of capitals and descenders at scale 1

cv::Scalar color(Ink ink) {
    return {static_cast<double>(ink[0]), static_cast<double>(ink[1]), static_cast<double>(ink[2])};
}

class PngCanvas : public Canvas {
  public:
    // Drawn at twice the size and reduced, because OpenCV's antialiasing leaves thin strokes
    // ragged.
    static constexpr double kOversize = 2.0;

    PngCanvas(int width, int height)
        : image_(static_cast<int>(height * kOversize), static_cast<int>(width * kOversize), CV_8UC3,
                 cv::Scalar(255, 255, 255)) {}

    void line(const std::vector<Eigen::Vector2d>& points, Ink ink, double width) override {
        const int thickness = std::max(1, static_cast<int>(std::lround(width * kOversize)));
        for (std::size_t i = 1; i < points.size(); ++i) {
            cv::line(image_, pixel(points[i - 1]), pixel(points[i]), color(ink), thickness,
                     cv::LINE_AA);
        }
    }

    void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Ink ink) override {
        cv::rectangle(image_, pixel(low), pixel(high), color(ink), cv::FILLED);
    }

    void dot(const Eigen::Vector2d& center, double radius, Ink ink) override {
        cv::circle(image_, pixel(center), static_cast<int>(std::lround(radius * kOversize)),
                   color(ink), cv::FILLED, cv::LINE_AA);
    }

    void text(const Eigen::Vector2d& at, const std::string& text, double size, Align align,
              Ink ink) override {
        const double scale = size * kOversize / kFontHeight;
        int below = 0;
        const cv::Size extent = cv::getTextSize(text, kFont, scale, kThickness, &below);
        cv::Point corner = pixel(at);
        if (align == Align::Middle) corner.x -= extent.width / 2;
        if (align == Align::Right) corner.x -= extent.width;
        cv::putText(image_, text, corner, kFont, scale, color(ink), kThickness, cv::LINE_AA);
    }

    std::string finish() override {
        cv::Mat small;
        cv::resize(image_, small, {}, 1.0 / kOversize, 1.0 / kOversize, cv::INTER_AREA);
        const auto png = encodePng(small.cols, small.rows, PngFormat::Rgb8,
                                   {small.data, small.total() * small.elemSize()});
        return png ? std::string(png->begin(), png->end()) : std::string();
    }

  private:
    static constexpr int kThickness = 2;

    static cv::Point pixel(const Eigen::Vector2d& p) {
        return {static_cast<int>(std::lround(p.x() * kOversize)),
                static_cast<int>(std::lround(p.y() * kOversize))};
    }

    cv::Mat image_;
};

}  // namespace

std::unique_ptr<Canvas> makePngCanvas(int width, int height) {
    return std::make_unique<PngCanvas>(width, height);
}

}  // namespace dollytrack::render
