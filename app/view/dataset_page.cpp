#include "app/view/dataset_page.h"

#include "app/view/base64.h"
#include "app/view/frame_pictures.h"
#include "app/view/page_data.h"
#include "app/view/page_files.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostTriangles = 100'000;
constexpr std::size_t kFewTriangles = 20'000;  // used if frames and objects take most of the page
constexpr std::size_t kReserve = 20'000;       // bytes for parts that are not counted beforehand

Result<std::string> threeScript(const std::filesystem::path& folder) {
    std::string script;
    for (const char* name : {"three.min.js", "examples/js/controls/OrbitControls.js"}) {
        const Result<std::string> text = readText(folder / name, 16);
        if (!text || text->find("</script") != std::string::npos) {
            return fail(ErrorCode::BadInput,
                        "three.js, which draws the 3D view, is missing; install Debian's package "
                        "libjs-three.",
                        (folder / name).string());
        }
        script += *text + "\n";
    }
    return script;
}

/// JSON for a script element, with all '<' escaped.
std::string scriptJson(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<') {
            safe += "\\u003c";
        } else {
            safe += c;
        }
    }
    return safe;
}

std::string dataElement(std::string_view id, std::string_view type, std::string_view content) {
    return fmt::format("<script id=\"data-{}\" type=\"{}\">{}</script>\n", id, type, content);
}

std::string jsonElement(std::string_view id, const Json& json) {
    return dataElement(id, "application/json", scriptJson(json));
}

/// Numbers as base64, little-endian.
template <class Number>
std::string base64Numbers(const std::vector<Number>& numbers) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(numbers.size() * sizeof(Number));
    for (const Number number : numbers) {
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i) & 0xFFU));
        }
    }
    return base64(bytes);
}

struct RoomElements {
    std::string text;
    std::size_t triangles = 0;
};

RoomElements roomElements(const PageOrder& order, std::size_t most_triangles) {
    if (order.scene == nullptr) return {jsonElement("room", nullptr), 0};
    const Scene& scene = *order.scene;
    const ViewMesh mesh = makeViewMesh(scene, render::hidesRooms(scene), most_triangles);
    const auto storeys = storeysFor(scene, *order.rays, order.dataset);
    RoomElements elements{jsonElement("room", roomData(scene, mesh, storeys)),
                          mesh.corners.size() / 3};
    elements.text += dataElement("positions", "text/plain", base64Numbers(mesh.positions));
    elements.text += dataElement("colors", "text/plain", base64(mesh.colors));
    elements.text += dataElement("corners", "text/plain", base64Numbers(mesh.corners));
    return elements;
}

std::string pictureElements(const FramePictures& pictures) {
    Json kinds = Json::array();
    for (const PictureKind& kind : pictures.kinds) {
        Json files = Json::array();
        for (const auto& file : kind.files) files.push_back(base64(file));
        kinds.push_back({{"modality", kind.modality},
                         {"text", kind.text},
                         {"type", render::smallPictureType(kind.modality)},
                         {"files", std::move(files)}});
    }
    return jsonElement("pictures", kinds);
}

/// Notes for readers of the page, as sentences.
Json notesOf(const PageOrder& order, const FramePictures& pictures, std::size_t pictured) {
    Json notes = Json::array();
    if (order.scene == nullptr) {
        notes.push_back("The page shows no room surfaces: " + order.no_scene + ".");
    }
    if (pictures.kinds.empty()) {
        notes.push_back("The dataset has no colour, depth or label images.");
    } else if (pictured < order.dataset.frames.size()) {
        notes.push_back(fmt::format("To keep the page small, it has images of {} of {} frames.",
                                    pictured, order.dataset.frames.size()));
    }
    if (pictures.unreadable > 0) {
        notes.push_back(
            fmt::format("Missing or damaged images in the dataset: {}.", pictures.unreadable));
    }
    return notes;
}

Error tooLarge(const PageOrder& order) {
    return {ErrorCode::BadInput,
            fmt::format("Its {} frames and {} objects do not fit in a page of {} MB; export a part "
                        "of the frames with --range.",
                        order.dataset.frames.size(), order.dataset.objects.size(),
                        kMostPageBytes / 1'000'000),
            order.dataset.folder.string()};
}

}  // namespace

Result<DatasetPage> makeDatasetPage(const PageOrder& order, const JobContext& job) {
    const Result<std::string> three = threeScript(order.three_folder);
    if (!three) return tl::unexpected(three.error());
    if (leastDataBytes(order.dataset) > kMostPageBytes) {
        return tl::unexpected(tooLarge(order));
    }
    const PageFiles& files = pageFiles();
    const Json data = pageData(order.dataset);
    std::string fixed = dataElement("three", "text/javascript", *three);
    const std::size_t known = files.size() + fixed.size() + scriptJson(data).size() + kReserve;
    if (known > kMostPageBytes / 2 + kMostPageBytes / 4) {
        return tl::unexpected(tooLarge(order));
    }
    job.report(0.05);
    const RoomElements room =
        roomElements(order, known > kMostPageBytes / 2 ? kFewTriangles : kMostTriangles);
    job.report(0.4);
    const std::size_t taken = known + room.text.size();
    if (taken > kMostPageBytes) return tl::unexpected(tooLarge(order));
    const Result<FramePictures> pictures =
        makeFramePictures(order.dataset, bestFrames(order.dataset), kMostPageBytes - taken,
                          job.stage(0.4, 0.95, "pictures"));
    if (!pictures) return tl::unexpected(pictures.error());
    const std::size_t pictured = std::count(pictures->chosen.begin(), pictures->chosen.end(), true);
    DatasetPage page;
    page.triangles = room.triangles;
    page.pictures_of_frames = static_cast<int>(pictured);
    page.unreadable_pictures = pictures->unreadable;
    page.picture_width_px =
        pictured == 0 ? 0 : std::min(pictures->size.width_px, order.dataset.lens.width);
    page.html = files.head;
    page.html += jsonElement("dataset", data);
    page.html += jsonElement("notes", notesOf(order, *pictures, pictured));
    page.html += room.text;
    page.html += pictureElements(*pictures);
    page.html += fixed;
    page.html += dataElement("page", "text/javascript", files.script);
    page.html += files.end;
    if (page.html.size() >= kMostPageBytes) return tl::unexpected(tooLarge(order));
    return page;
}

}  // namespace dollytrack::view
