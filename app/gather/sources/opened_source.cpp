#include "app/gather/sources/opened_source.h"

#include "render/verify/read/coco_annotations.h"

#include <fmt/format.h>

namespace dollytrack::gather {
namespace {

using nlohmann::json;
using Json = nlohmann::ordered_json;

/// The frame index of a COCO annotation. Throws nlohmann's exceptions.
std::size_t frameOf(const json& one, std::size_t frames) {
    const auto image = one.at("image_id").get<std::size_t>();
    return image >= 1 && image <= frames ? image - 1 : frames;
}

/// Throws nlohmann's exceptions.
Annotation annotationOf(const json& one, const ClassTable& table, const ClassUnion& classes,
                        bool& known) {
    Annotation read;
    const DatasetClass* of = table.find(one.at("category_id").get<int>());
    known = of != nullptr && of != &table.voidClass();
    if (known) read.class_index = classes.indexOf(*of);
    read.object_id = one.at("object_id").get<int>();
    read.box = one.at("bbox").get<std::array<int, 4>>();
    read.area = one.at("area").get<long>();
    read.segmentation = one.at("segmentation").dump();
    read.segmentation.shrink_to_fit();  // all annotations of a dataset are in memory at once
    return read;
}

Status readAnnotations(const std::string& text, const std::string& where, const ClassUnion& classes,
                       OpenedSource& opened) {
    return verify::forEachAnnotation(text, where, [&](const json& value) {
        bool known = false;
        const std::size_t frame = frameOf(value, opened.annotations.size());
        Annotation one = annotationOf(value, opened.source.classes(), classes, known);
        if (!known || frame == opened.annotations.size()) return false;
        opened.annotations[frame].push_back(std::move(one));
        return true;
    });
}

}  // namespace

std::string OpenedSource::frameName(std::size_t frame) const {
    return fmt::format("{}_{:06}", source.name, frame);
}

SourceFile OpenedSource::file(const std::string& name) const {
    const auto listed = dataset.sha256s.find(name);
    return {source.folder / name, listed == dataset.sha256s.end() ? "" : listed->second};
}

std::vector<std::string> OpenedSource::filesOf(const std::string& folder, std::size_t frame) const {
    const std::string beginning = fmt::format("{}/{:06}", folder, frame);
    std::vector<std::string> names;
    for (auto at = dataset.sha256s.lower_bound(beginning);
         at != dataset.sha256s.end() && at->first.starts_with(beginning); ++at) {
        const std::string name = at->first.substr(folder.size() + 1);
        const char next = at->first.c_str()[beginning.size()];
        const bool is_longer_number = next >= '0' && next <= '9';
        if (!is_longer_number && name.find('/') == std::string::npos) names.push_back(name);
    }
    return names;
}

Result<verify::StoredDataset> readDescription(const Source& source) {
    Result<verify::StoredDataset> dataset = verify::readStoredDataset(source.folder);
    if (!dataset) return tl::unexpected(dataset.error());
    if (dataset->card_sha256 != source.card_sha256) {
        return fail(ErrorCode::BadInput,
                    "The dataset was changed while it was read; gather it again.",
                    source.folder.string());
    }
    return dataset;
}

void keepConventionsOnly(verify::StoredDataset& dataset) {
    dataset.card = {{"conventions", Json(dataset.card.at("conventions"))}};
}

Result<OpenedSource> openSource(const Source& source, const ClassUnion& classes) {
    Result<verify::StoredDataset> dataset =
        source.kept ? Result<verify::StoredDataset>(*source.kept) : readDescription(source);
    if (!dataset) return tl::unexpected(dataset.error());
    keepConventionsOnly(*dataset);  // before annotations.json is read, which is large, too
    const Result<SourceFile> file = listedFile(*dataset, kAnnotationFile);
    if (!file) return tl::unexpected(file.error());
    const Result<std::string> text = readProven(*file);
    if (!text) return tl::unexpected(text.error());
    OpenedSource opened{source, std::move(*dataset), {}};
    opened.annotations.resize(source.frames);
    if (Status read = readAnnotations(*text, file->path.string(), classes, opened); !read) {
        return tl::unexpected(read.error());
    }
    return opened;
}

}  // namespace dollytrack::gather
