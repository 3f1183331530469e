#include "app/statistics/statistics_page.h"

#include "app/batch/markup.h"
#include "app/statistics/charts.h"
#include "app/statistics/page_tables.h"
#include "app/statistics/page_text.h"
#include "app/statistics/plot_frame.h"
#include "app/view/base64.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace dollytrack {

extern const char* const kStatisticsStyle;  // assets/statistics/page.css

}  // namespace dollytrack

namespace dollytrack::statistics {
namespace {

using Datasets = std::span<const DatasetStatistics>;

std::string figure(std::string_view key, std::string_view title, std::string_view values,
                   std::string_view chart, std::string_view note) {
    return fmt::format(
        "<figure class=\"chart\" data-chart=\"{}\"><figcaption><h3>{}</h3>{}</figcaption>{}{}"
        "</figure>\n",
        key, title, values, chart,
        note.empty() ? "" : fmt::format("<p class=\"note\">{}</p>", note));
}

/// Medians and percentiles below the title of a histogram.
std::string spreadText(const QuantityInfo& info, Datasets datasets) {
    std::string text;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        const std::optional<Spread> spread = spreadOf(datasets[i].valuesOf(info.quantity));
        const auto number = [&](double value) { return numberText(value * info.factor); };
        const std::string spread_text =
            spread ? fmt::format("median {}{}, 80 % between {} and {}{}", number(spread->median),
                                 info.unit, number(spread->p10), number(spread->p90), info.unit)
                   : "no values";
        text += fmt::format("<p class=\"quiet{}\">{}</p>",
                            datasets.size() == 1 ? "" : fmt::format(" key s{}", i), spread_text);
    }
    return text;
}

/// The note of a histogram, with the share of values that its axis leaves out.
std::string noteOf(const QuantityInfo& info, const Bins& bins, Datasets datasets) {
    std::string note = batch::asMarkup(info.note);
    double most = 0.0;
    for (const DatasetStatistics& dataset : datasets) {
        const Histogram histogram = histogramOf(bins, dataset.valuesOf(info.quantity));
        if (histogram.total == 0) continue;
        most = std::max(
            most, static_cast<double>(histogram.beyond) / static_cast<double>(histogram.total));
    }
    if (most > 0.0) {
        note += fmt::format("{}{}{} % of the values lie beyond the axis.", note.empty() ? "" : " ",
                            datasets.size() == 1 ? "" : "Up to ", numberText(100.0 * most));
    }
    return note;
}

std::string histograms(Datasets datasets, const SharedBins& bins,
                       std::initializer_list<Quantity> chosen) {
    std::string text;
    for (const Quantity quantity : chosen) {
        const auto& shared = bins[static_cast<std::size_t>(quantity)];
        if (!shared) continue;
        const QuantityInfo& info = infoOf(quantity);
        text += figure(info.key, info.title, spreadText(info, datasets),
                       histogramChart(info, *shared, datasets), noteOf(info, *shared, datasets));
    }
    return text;
}

std::string section(std::string_view title, std::string_view charts) {
    if (charts.empty()) return {};
    return fmt::format("<h2>{}</h2>\n<div class=\"charts\">\n{}</div>\n", title, charts);
}

/// Number of datasets or scene, number of frames and size of the images.
std::string summaryOf(const DatasetStatistics& dataset) {
    std::string about = shownName(dataset.scene);
    if (dataset.datasets > 1) about = fmt::format("{} datasets", dataset.datasets);
    return fmt::format("<span class=\"quiet\">{}{}{} frames of {} × {} px</span>", about,
                       about.empty() ? "" : ", ", numberText(static_cast<double>(dataset.frames)),
                       dataset.width_px, dataset.height_px);
}

std::string header(Datasets datasets) {
    if (datasets.size() == 1) {
        return fmt::format("<h1>Statistics of {}</h1>\n<p>{}</p>\n", shownName(datasets[0].name),
                           summaryOf(datasets[0]));
    }
    std::string text =
        fmt::format("<h1>Statistics of {} datasets</h1>\n<div id=\"datasets\">", datasets.size());
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        text += fmt::format("<span class=\"key s{}\"><b>{}</b> {}</span>", i,
                            shownName(datasets[i].name), summaryOf(datasets[i]));
    }
    return text + "</div>\n";
}

std::string exampleFigure(const DatasetStatistics& dataset, std::size_t number,
                          const ExampleFrame& example, bool name_dataset) {
    std::string boxes;
    for (const ExampleBox& box : example.shown_boxes) {
        boxes += fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" "
            "stroke=\"#{:02x}{:02x}{:02x}\"><title>{} ({})</title></rect>",
            box.box[0], box.box[1], box.box[2], box.box[3], box.color[0], box.color[1],
            box.color[2], shownName(box.object), shownName(box.class_name));
    }
    const std::string count =
        dataset.has_boxes ? fmt::format(", {} box{}", example.boxes, example.boxes == 1 ? "" : "es")
                          : "";
    const std::string among =
        example.dataset.empty() ? "" : fmt::format("{}, ", shownName(example.dataset));
    return fmt::format(
        "<figure class=\"example\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Frame "
        "{}\"><image width=\"{}\" height=\"{}\" href=\"data:image/jpeg;base64,{}\"/>{}</svg>"
        "<figcaption>{}{}frame {}{}</figcaption></figure>\n",
        dataset.width_px, dataset.height_px, example.frame, dataset.width_px, dataset.height_px,
        view::base64(example.jpeg), boxes,
        name_dataset
            ? fmt::format("<span class=\"key s{}\">{}</span>, ", number, shownName(dataset.name))
            : "",
        among, example.frame, count);
}

std::string examples(Datasets datasets) {
    std::string text;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        for (const ExampleFrame& example : datasets[i].examples) {
            text += exampleFigure(datasets[i], i, example, datasets.size() > 1);
        }
    }
    if (text.empty()) return {};
    return fmt::format(
        "<h2>Example frames</h2>\n<div class=\"frames\">\n{}</div>\n<p class=\"note\">Evenly "
        "spaced "
        "frames with their boxes, in the colours of the classes; the pointer shows the name of an "
        "object.</p>\n",
        text);
}

/// The share of boxes that has the full colour in all heat maps.
double fullShare(Datasets datasets) {
    double share = 0.0;
    for (const DatasetStatistics& dataset : datasets) {
        share = std::max(share, fullShareOf(dataset.heat_map));
    }
    return share;
}

std::string heatMaps(Datasets datasets) {
    const double full_share = fullShare(datasets);
    std::string text;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        if (fullShareOf(datasets[i].heat_map) == 0.0) continue;
        const std::string name =
            datasets.size() == 1
                ? ""
                : fmt::format("<p class=\"quiet key s{}\">{}</p>", i, shownName(datasets[i].name));
        text += figure("box_centers", "Box centres over the image", name,
                       heatMapChart(datasets[i], i, full_share), "");
    }
    return text;
}

using ClassChart = std::string (*)(std::span<const ClassRow> rows);

/// The classes with the largest `number`; nothing if it is 0 everywhere.
std::string classFigure(Datasets datasets, std::size_t ClassStatistics::*number,
                        std::string_view counted, std::string_view key, std::string_view title,
                        std::string_view values, ClassChart chart) {
    std::vector<ClassRow> rows = classRowsOf(datasets, number);
    std::erase_if(rows, [&](const ClassRow& row) { return row.sum(number) == 0; });
    if (rows.empty()) return {};
    const std::size_t shown = chartClassesOf(rows);
    return figure(
        key, title, values, chart(rows),
        rows.size() > shown ? fmt::format("The {} classes with the most {}.", shown, counted) : "");
}

std::string classSection(Datasets datasets) {
    const std::vector<ClassRow> rows = classRowsOf(datasets, &ClassStatistics::boxes);
    if (rows.empty()) return {};
    const std::string charts =
        classFigure(datasets, &ClassStatistics::boxes, "boxes", "boxes_by_class", "Boxes by class",
                    "", boxesByClassChart) +
        classFigure(datasets, &ClassStatistics::targets, "target objects", "captured_by_class",
                    "Captured objects by class",
                    "<p class=\"quiet\">filled: captured, outlined: all target objects</p>",
                    capturedByClassChart);
    return section("Classes", charts) + classTable(rows, datasets);
}

std::string boxSection(Datasets datasets, const SharedBins& bins) {
    return section(
        "Sizes, distances, visibility and places",
        histograms(datasets, bins,
                   {Quantity::BoxShare, Quantity::MaskShare, Quantity::AspectRatio,
                    Quantity::BoxesPerFrame, Quantity::Distance, Quantity::VisibleFraction,
                    Quantity::Truncation, Quantity::BestVisibleFraction}) +
            heatMaps(datasets));
}

/// Which charts are missing, and how to get them.
std::string missingCharts(const SharedBins& bins) {
    std::string text;
    for (const QuantityInfo& info : quantities()) {
        if (bins[static_cast<std::size_t>(info.quantity)] || *info.source == '\0') continue;
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", info.title, info.source);
    }
    if (text.empty()) return {};
    return fmt::format(
        "<p class=\"note\">Not shown, because no dataset has values: {}. The option of "
        "<code>dollytrack export</code> is in brackets.</p>\n",
        text);
}

std::string imageNote(Datasets datasets) {
    std::size_t most = 0;
    bool depth = false;
    for (const DatasetStatistics& dataset : datasets) {
        most = std::max(most, dataset.image_frames);
        depth = depth || !dataset.valuesOf(Quantity::Depth).empty();
    }
    if (most == 0) return {};
    return fmt::format("<p class=\"note\">Measured in {} evenly spaced frames{}{}.</p>\n", most,
                       datasets.size() == 1 ? "" : " or fewer of each dataset",
                       depth ? "; depth at a grid of pixels" : "");
}

}  // namespace

std::string statisticsPage(Datasets datasets) {
    const SharedBins bins = sharedBinsOf(datasets);
    const bool single = datasets.size() == 1;
    std::string body = header(datasets);
    body += "<h2>Overview</h2>\n";
    body += overviewTable(datasets);
    if (!single) {
        body += "<p class=\"note\">Small numbers are differences from the first dataset.</p>\n";
    }
    body += examples(datasets);
    body += classSection(datasets) + boxSection(datasets, bins);
    body += section("Camera", histograms(datasets, bins,
                                         {Quantity::CameraHeight, Quantity::CameraPitch,
                                          Quantity::Speed, Quantity::TurnRate}));
    const std::string images =
        section("Images", histograms(datasets, bins, {Quantity::Depth, Quantity::Luma}));
    if (!images.empty()) body += images + imageNote(datasets);
    body += missingCharts(bins);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Statistics of {}</title>\n"
        "<style>{}</style></head>\n<body>\n{}</body></html>\n",
        single ? shownName(datasets[0].name) : fmt::format("{} datasets", datasets.size()),
        kStatisticsStyle, body);
}

}  // namespace dollytrack::statistics
