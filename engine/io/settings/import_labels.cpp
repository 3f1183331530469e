#include "engine/io/settings/import_labels.h"

#include "engine/io/settings/class_table_file.h"

#include <utility>

namespace dollytrack {

Result<ImportLabels> importLabels(const ImportOptions& options) {
    ImportLabels labels{LabelTable::builtIn(), nullptr};
    if (!options.labels) return labels;
    Result<LabelFile> file = readLabelFile(*options.labels);
    if (!file) return tl::unexpected(file.error());
    if (Status added = labels.words.add(file->word_lines, file->word_place); !added) {
        return tl::unexpected(added.error());
    }
    labels.classes = std::move(file->classes);
    return labels;
}

Result<LabelTable> labelsOf(const ImportOptions& options) {
    Result<ImportLabels> labels = importLabels(options);
    if (!labels) return tl::unexpected(labels.error());
    return std::move(labels->words);
}

}  // namespace dollytrack
