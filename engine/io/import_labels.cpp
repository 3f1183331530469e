#include "engine/io/import_labels.h"

namespace dollytrack {

Result<LabelTable> labelsOf(const ImportOptions& options) {
    LabelTable table = LabelTable::builtIn();
    if (options.labels) {
        if (Status added = table.addFile(*options.labels); !added) {
            return tl::unexpected(added.error());
        }
    }
    return table;
}

}  // namespace dollytrack
