#include "render/dataset/dataset_files.h"

#include "engine/io/files/sha256.h"
#include "render/dataset/contact_sheet.h"
#include "render/formats/picture_links.h"
#include "render/formats/tables/fold_files.h"

#include <fmt/format.h>

#include <span>

namespace dollytrack::render {
namespace {

constexpr const char* kSheet = "contact_sheet.jpg";

std::span<const std::uint8_t> bytesOf(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Result<std::vector<std::uint8_t>> contactSheet(const GuardedFolder& folder,
                                               const DatasetContents& contents,
                                               const std::string& title) {
    std::vector<bool> is_key;
    for (const DatasetFrame& frame : contents.frames) {
        is_key.push_back(frame.camera.position_point >= 0);
    }
    std::vector<SheetPicture> pictures;
    for (const int index : chooseSheetFrames(is_key)) {
        const DatasetFrame& frame = contents.frames[index];
        // printf() would use the locale's decimal separator.
        pictures.push_back(
            {contents.pictureFile(index),
             fmt::format("{}   {:.1f} s   {:.24}", index, frame.camera.time_s, frame.room)});
    }
    return encodeContactSheet(folder, pictures, contents.pictureModality(),
                              contents.scene.classes(), title);
}

}  // namespace

Status writeDatasetFiles(const GuardedFolder& folder, const DatasetContents& contents,
                         DatasetCard card, const std::string& title) {
    const auto put = [&](const std::string& name, std::span<const std::uint8_t> bytes) -> Status {
        card.sha256s[name] = sha256Of(bytes);
        return folder.write(name, bytes, Durability::Renamed);
    };
    for (const Format* format : card.formats) {
        if (!format->write) continue;
        const Result<std::vector<DatasetFile>> files = format->write(contents);
        if (!files) return tl::unexpected(files.error());
        for (const DatasetFile& file : *files) {
            if (Status status = put(file.path, bytesOf(file.bytes)); !status) return status;
        }
    }
    for (const auto& [name, picture] : pictureLinks(contents, card.formats)) {
        const auto written = card.sha256s.find(picture);
        if (written == card.sha256s.end()) {
            return fail(ErrorCode::Failed, "the image was not written", picture);
        }
        if (Status status = folder.link(picture, name); !status) return status;
        card.sha256s[name] = written->second;
    }
    const Result<std::vector<DatasetFile>> folds = foldFiles(contents, card.formats);
    if (!folds) return tl::unexpected(folds.error());
    for (const DatasetFile& file : *folds) {
        if (Status status = put(file.path, bytesOf(file.bytes)); !status) return status;
    }
    if (!card.licenses.empty()) {
        if (Status status = put(kLicensesFile, bytesOf(card.licenses)); !status) return status;
    }
    if (contents.pictureModality().is_picture) {
        const auto sheet = contactSheet(folder, contents, title);
        if (!sheet) return tl::unexpected(sheet.error());
        if (Status status = put(kSheet, *sheet); !status) return status;
    }

    const nlohmann::ordered_json json = datasetCardJson(contents, card);
    const std::string text =
        json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    // All files that dataset.json lists must be on disk before it appears.
    if (Status status = folder.syncAll(); !status) return status;
    return folder.write("dataset.json", text);
}

}  // namespace dollytrack::render
