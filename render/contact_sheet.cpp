#include "render/contact_sheet.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <map>

namespace dollytrack::render {
namespace {

constexpr int kMaxPictures = 24;
constexpr int kColumns = 6;
constexpr int kThumbWidth = 320;
constexpr int kGap = 8;
constexpr int kCaption = 22;
constexpr int kTitle = 44;

void writeText(cv::Mat& page, const std::string& text, int x, int y, double size, int grey) {
    cv::putText(page, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(grey), 1,
                cv::LINE_AA);
}

}  // namespace

struct ContactSheet::Impl {
    int thumb_height = 0;
    std::vector<int> chosen;
    std::map<int, std::pair<cv::Mat, std::string>> pictures;
};

ContactSheet::ContactSheet(const std::vector<bool>& is_key, int width, int height)
    : impl_(std::make_unique<Impl>()) {
    impl_->thumb_height = std::max(1, kThumbWidth * height / std::max(width, 1));
    std::vector<int> frames;
    const bool enough_keys = std::count(is_key.begin(), is_key.end(), true) >= kMaxPictures / 2;
    for (std::size_t i = 0; i < is_key.size(); ++i) {
        if (is_key[i] || !enough_keys) frames.push_back(static_cast<int>(i));
    }
    const std::size_t count = std::min<std::size_t>(frames.size(), kMaxPictures);
    for (std::size_t i = 0; i < count; ++i) {
        // The first and the last are among them.
        impl_->chosen.push_back(frames[count == 1 ? 0 : i * (frames.size() - 1) / (count - 1)]);
    }
}
ContactSheet::~ContactSheet() = default;
ContactSheet::ContactSheet(ContactSheet&&) noexcept = default;
ContactSheet& ContactSheet::operator=(ContactSheet&&) noexcept = default;

bool ContactSheet::wants(int index) const {
    return std::binary_search(impl_->chosen.begin(), impl_->chosen.end(), index);
}

void ContactSheet::add(const FrameRecord& frame, const std::string& caption) {
    const cv::Mat rgb(frame.height, frame.width, CV_8UC3,
                      const_cast<std::uint8_t*>(frame.rgb.data()));
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    cv::Mat thumb;
    cv::resize(bgr, thumb, {kThumbWidth, impl_->thumb_height}, 0, 0, cv::INTER_AREA);
    impl_->pictures[frame.index] = {thumb, caption};
}

Result<std::vector<std::uint8_t>> ContactSheet::encode(const std::string& title) const {
    const int count = std::max<int>(static_cast<int>(impl_->pictures.size()), 1);
    const int columns = std::min(kColumns, count);
    const int rows = (count + columns - 1) / columns;
    const int step_x = kThumbWidth + kGap;
    const int step_y = impl_->thumb_height + kCaption + kGap;
    cv::Mat page(kTitle + rows * step_y + kGap, columns * step_x + kGap, CV_8UC3,
                 cv::Scalar(32, 30, 28));
    writeText(page, title, kGap, 29, 0.65, 235);
    int place = 0;
    for (const auto& [index, picture] : impl_->pictures) {
        const int x = kGap + place % columns * step_x;
        const int y = kTitle + place / columns * step_y;
        picture.first.copyTo(page(cv::Rect(x, y, kThumbWidth, impl_->thumb_height)));
        writeText(page, picture.second, x + 2, y + impl_->thumb_height + 16, 0.45, 200);
        ++place;
    }
    std::vector<std::uint8_t> bytes;
    try {
        cv::imencode(".jpg", page, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
    } catch (const cv::Exception& problem) {
        return fail(ErrorCode::Failed, std::string("the contact sheet: ") + problem.what());
    }
    return bytes;
}

}  // namespace dollytrack::render
