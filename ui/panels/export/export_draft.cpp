#include "ui/panels/export/export_draft.h"

#include "ui/widgets/text_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace dollytrack::ui {
namespace {

/// The selected frames, clamped to the trajectory; `end` is exclusive.
struct Frames {
    int begin = 0;
    int end = 0;
    int step = 1;
};

Frames framesOf(const ExportView& view, const ExportDraft& draft) {
    if (draft.current_only) return {view.current_frame, view.current_frame + 1, 1};
    if (isReversed(draft)) return {draft.first, draft.first, 1};
    const int last = draft.last < 0 ? view.frame_count - 1 : draft.last;
    Frames frames;
    frames.begin = std::clamp(draft.first, 0, std::max(view.frame_count - 1, 0));
    frames.end =
        std::clamp(last + 1, frames.begin + 1, std::max(view.frame_count, frames.begin + 1));
    frames.step = std::max(draft.step, 1);
    return frames;
}

bool isIn(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

std::vector<std::string> chosen(const std::vector<ExportChoice>& all,
                                const std::vector<std::string>& turned) {
    std::vector<std::string> names;
    for (const ExportChoice& choice : all) {
        if (isWritten(choice, turned)) names.push_back(choice.name);
    }
    return names;
}

/// The names whose check box has to differ from the default so that only `names` are selected.
std::vector<std::string> turnedFor(const std::vector<ExportChoice>& all,
                                   const std::vector<std::string>& names) {
    std::vector<std::string> turned;
    for (const ExportChoice& choice : all) {
        if (choice.standard != isIn(names, choice.name)) turned.push_back(choice.name);
    }
    return turned;
}

/// Appends the choices whose selection differs from `names`.
void addChanges(const std::vector<ExportChoice>& all, const std::vector<std::string>& turned,
                const std::vector<std::string>& names, std::string& text) {
    for (const ExportChoice& choice : all) {
        const bool wanted = isWanted(choice, turned);
        if (wanted == isIn(names, choice.name)) continue;
        text += (text.empty() ? "" : ", ") + std::string(wanted ? "+ " : "- ") + choice.name;
    }
}

std::string bytesText(double bytes) {
    if (bytes >= 1e9) return fmt::format("{:.1f} GB", bytes / 1e9);
    return fmt::format("{:.0f} MB", std::max(bytes / 1e6, 1.0));
}

/// Whether the text is a list of positive whole numbers: "1,5".
bool areDistances(const std::string& text) {
    std::istringstream parts(text);
    bool any = false;
    for (std::string part; std::getline(parts, part, ',');) {
        const bool whole = !part.empty() && part.size() < 6 && part[0] != '0' &&
                           part.find_first_not_of("0123456789") == std::string::npos;
        if (!whole) return false;
        any = true;
    }
    return any && text.back() != ',';
}

}  // namespace

bool isReversed(const ExportDraft& draft) {
    return !draft.current_only && draft.last >= 0 && draft.first > draft.last;
}

bool isWanted(const ExportChoice& choice, const std::vector<std::string>& turned) {
    return choice.standard != isIn(turned, choice.name);
}

bool isWritten(const ExportChoice& choice, const std::vector<std::string>& turned) {
    return choice.why_not.empty() && isWanted(choice, turned);
}

bool matchesFilter(const ExportChoice& choice, const std::string& filter) {
    return containsIgnoringCase(choice.name, filter) || containsIgnoringCase(choice.text, filter) ||
           containsIgnoringCase(choice.group, filter);
}

void choosePreset(const ExportView& view, const ExportPresetChoice& preset, ExportDraft& draft) {
    draft.preset = preset.name;
    draft.turned_modalities = turnedFor(view.modalities, preset.modalities);
    draft.turned_formats = turnedFor(view.formats, preset.formats);
}

const ExportPresetChoice* chosenPreset(const ExportView& view, const ExportDraft& draft) {
    const auto found = std::ranges::find(view.presets, draft.preset, &ExportPresetChoice::name);
    if (found != view.presets.end()) return &*found;
    return view.presets.empty() ? nullptr : &view.presets.front();
}

std::string changesOfPreset(const ExportView& view, const ExportDraft& draft) {
    const ExportPresetChoice* preset = chosenPreset(view, draft);
    std::string text;
    if (preset == nullptr) return text;
    addChanges(view.modalities, draft.turned_modalities, preset->modalities, text);
    addChanges(view.formats, draft.turned_formats, preset->formats, text);
    return text;
}

std::string leftOut(const ExportView& view, const ExportDraft& draft) {
    std::string text;
    for (const ExportChoice& choice : view.modalities) {
        if (choice.why_not.empty() || !isWanted(choice, draft.turned_modalities)) continue;
        text += (text.empty() ? "" : ", ") + choice.name;
    }
    return text;
}

std::string rangeNote(const ExportView& view, const ExportDraft& draft) {
    const int last = view.frame_count - 1;
    if (view.frame_count == 0 || draft.current_only) return {};
    if (isReversed(draft)) {
        return fmt::format("The range {} to {} is empty: its last frame comes before its first.",
                           draft.first, draft.last);
    }
    if (draft.first > last) return fmt::format("The last frame of the trajectory is {}.", last);
    if (draft.last <= last && draft.first >= 0) return {};
    const Frames frames = framesOf(view, draft);
    return fmt::format("The frames are 0 to {}: {} to {} are exported.", last, frames.begin,
                       frames.end - 1);
}

std::string summaryOf(const ExportView& view, const ExportDraft& draft) {
    const int count = frameCountOf(view, draft);
    if (count == 0) return view.project.empty() ? "No project is open." : view.project;
    std::string text =
        fmt::format("{}: {} frame{} of {} \u00d7 {} px", view.project, count, count == 1 ? "" : "s",
                    view.camera.width_px, view.camera.height_px);
    if (view.bytes_per_frame > 0.0) {
        text += ", at most about " + bytesText(count * view.bytes_per_frame);
    }
    return text;
}

bool wantsFlow(const ExportView& view, const ExportDraft& draft) {
    const auto names = chosen(view.modalities, draft.turned_modalities);
    return isIn(names, "flow_forward") || isIn(names, "flow_backward") || isIn(names, "scene_flow");
}

bool wantsSensors(const ExportView& view, const ExportDraft& draft) {
    const auto names = chosen(view.modalities, draft.turned_modalities);
    return isIn(names, "rgb_sensor") || isIn(names, "depth_sensor");
}

bool wantsPictures(const ExportView& view, const ExportDraft& draft) {
    const auto wanted = [](const std::vector<ExportChoice>& all,
                           const std::vector<std::string>& turned) {
        return std::ranges::any_of(all, [&](const ExportChoice& choice) {
            return choice.colour && isWritten(choice, turned);
        });
    };
    return !draft.rig.empty() || wanted(view.modalities, draft.turned_modalities) ||
           wanted(view.formats, draft.turned_formats);
}

std::string whyNot(const ExportView& view, const ExportDraft& draft) {
    if (!view.why_not.empty()) return view.why_not;
    if (view.frame_count == 0) return "The trajectory has no frames.";
    if (draft.folder.empty()) return "Choose a folder first.";
    if (!view.why_not_folder.empty()) return view.why_not_folder;
    if (isReversed(draft)) return rangeNote(view, draft);
    if (!draft.current_only && draft.first >= view.frame_count) return rangeNote(view, draft);
    // The command line reads an empty list as the default set.
    if (!view.modalities.empty() && chosen(view.modalities, draft.turned_modalities).empty()) {
        return "Choose at least one modality.";
    }
    if (!view.formats.empty() && chosen(view.formats, draft.turned_formats).empty()) {
        return "Choose at least one format.";
    }
    if (wantsFlow(view, draft) && !areDistances(draft.flow_distances)) {
        return "Flow distances are whole numbers of frames, as in 1,5.";
    }
    return {};
}

int frameCountOf(const ExportView& view, const ExportDraft& draft) {
    if (view.frame_count == 0) return 0;
    const Frames frames = framesOf(view, draft);
    return (frames.end - frames.begin + frames.step - 1) / frames.step;
}

std::string rangeForOthers(const ExportDraft& draft) {
    // The current frame has no counterpart in other projects.
    if (draft.current_only) return "::";
    const std::string first = draft.first > 0 ? std::to_string(draft.first) : "";
    const std::string end = draft.last >= 0 ? std::to_string(draft.last + 1) : "";
    const std::string step = draft.step > 1 ? std::to_string(draft.step) : "";
    return first + ":" + end + ":" + step;
}

ExportRequest requestOf(const ExportView& view, const ExportDraft& draft) {
    const Frames frames = framesOf(view, draft);
    ExportRequest request;
    request.name = view.project;
    request.folder = draft.folder;
    // Without a range, the command line can resume this export without repeating the range.
    if (frames.begin != 0 || frames.end != view.frame_count || frames.step != 1) {
        request.range = fmt::format("{}:{}:{}", frames.begin, frames.end, frames.step);
    }
    if (!draft.turned_modalities.empty()) {
        request.modalities = chosen(view.modalities, draft.turned_modalities);
    }
    if (!draft.turned_formats.empty()) {
        request.formats = chosen(view.formats, draft.turned_formats);
    }
    if (wantsFlow(view, draft) && draft.flow_distances != "1") {
        request.flow_distances = draft.flow_distances;
    }
    request.rig = draft.rig;
    request.still = view.has_tracks && draft.still;
    request.overwrite = draft.overwrite;
    request.frames = frameCountOf(view, draft);
    return request;
}

}  // namespace dollytrack::ui
