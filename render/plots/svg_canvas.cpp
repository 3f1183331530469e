#include "render/plots/canvas.h"

#include <fmt/format.h>

namespace dollytrack::render {
namespace {

std::string hex(Ink ink) {
    return fmt::format("#{:02x}{:02x}{:02x}", ink[0], ink[1], ink[2]);
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            default:
                // XML allows no other control characters.
                result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return result;
}

class SvgCanvas : public Canvas {
  public:
    SvgCanvas(int width, int height)
        : text_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" "
                            "height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\">\n",
                            width, height)) {}

    void line(const std::vector<Eigen::Vector2d>& points, Ink ink, double width) override {
        text_ += "<polyline fill=\"none\" stroke-linejoin=\"round\" points=\"";
        for (const auto& p : points) text_ += fmt::format("{:.2f},{:.2f} ", p.x(), p.y());
        text_ += fmt::format("\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n", hex(ink), width);
    }

    void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Ink ink) override {
        text_ += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
            low.x(), low.y(), high.x() - low.x(), high.y() - low.y(), hex(ink));
    }

    void dot(const Eigen::Vector2d& center, double radius, Ink ink) override {
        text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.1f}\" fill=\"{}\"/>\n",
                             center.x(), center.y(), radius, hex(ink));
    }

    void text(const Eigen::Vector2d& at, const std::string& text, double size, Align align,
              Ink ink) override {
        const char* anchor = align == Align::Left     ? "start"
                             : align == Align::Middle ? "middle"
                                                      : "end";
        text_ += fmt::format(
            "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.0f}\" text-anchor=\"{}\" "
            "fill=\"{}\">{}</text>\n",
            at.x(), at.y(), size, anchor, hex(ink), escaped(text));
    }

    std::string finish() override { return text_ + "</svg>\n"; }

  private:
    std::string text_;
};

}  // namespace

std::unique_ptr<Canvas> makeSvgCanvas(int width, int height) {
    return std::make_unique<SvgCanvas>(width, height);
}

}  // namespace dollytrack::render
