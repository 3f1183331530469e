#include "render/formats/picture_links.h"

#include "render/formats/labels/yolo.h"
#include "render/formats/poses/euroc.h"

namespace dollytrack::render {

PictureLinks pictureLinks(const DatasetContents& contents, const FormatSet& formats) {
    PictureLinks links;
    for (const Format* format : formats) {
        const std::string_view name = format->name;
        if (name == kYoloFormat.name) links.merge(yoloPictures(contents));
        if (name == kEurocFormat.name) links.merge(eurocPictures(contents));
    }
    return links;
}

}  // namespace dollytrack::render
