#pragma once

#include "render/gl/picture_texture.h"

#include <array>
#include <mutex>
#include <utility>

namespace dollytrack::ui {

/// Triple buffer between the threads: one image is shown, one is finished, one is being drawn.
template <class Image>
struct ImageRelay {
    std::array<Image, 3> images;
    int shown = 0;
    int finished = 1;
    int drawn = 2;
    bool news = false;

    /// Window's thread: takes the finished image and uploads it to the texture.
    void takeNews(std::mutex& mutex, gl::PictureTexture& picture) {
        {
            const std::lock_guard lock(mutex);
            if (!std::exchange(news, false)) return;
            std::swap(shown, finished);
        }
        // The render thread does not touch the shown image.
        Image& image = images[shown];
        picture.upload(image.width, image.height, image.rgba);
        image.texture = picture.get();
    }

    [[nodiscard]] const Image& newest() const { return images[shown]; }
};

}  // namespace dollytrack::ui
