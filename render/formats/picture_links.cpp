#include "render/formats/picture_links.h"

#include "engine/io/durable_file.h"
#include "engine/io/text_file.h"
#include "render/formats/euroc.h"
#include "render/formats/yolo.h"

#include <span>
#include <system_error>

namespace dollytrack::render {

namespace fs = std::filesystem;

PictureLinks pictureLinks(const DatasetContents& contents, const FormatSet& formats) {
    PictureLinks links;
    for (const Format* format : formats) {
        const std::string_view name = format->name;
        if (name == kYoloFormat.name) links.merge(yoloPictures(contents));
        if (name == kEurocFormat.name) links.merge(eurocPictures(contents));
    }
    return links;
}

Status linkPicture(const fs::path& folder, const std::string& name, const std::string& picture) {
    const fs::path link = folder / name;
    std::error_code error;
    fs::create_directories(link.parent_path(), error);
    if (error) return tl::unexpected<Error>(io::writeError(error.value(), link.parent_path()));
    fs::remove(link, error);
    if (error) return tl::unexpected<Error>(io::writeError(error.value(), link));
    fs::create_hard_link(folder / picture, link, error);
    if (!error) return {};
    const Result<std::string> bytes = io::readText(folder / picture);
    if (!bytes) return tl::unexpected(bytes.error());
    return io::writeWhole(link, *bytes, io::Durability::Renamed);
}

}  // namespace dollytrack::render
