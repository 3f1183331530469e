#include "engine/io/files/input_record.h"

#include <atomic>
#include <tuple>
#include <utility>

namespace dollytrack {
namespace {

std::atomic<InputRecord*> current = nullptr;

}  // namespace

bool InputUse::operator<(const InputUse& other) const {
    return std::tie(kind, path.native(), identity) <
           std::tie(other.kind, other.path.native(), other.identity);
}

InputRecord::InputRecord(std::function<void(const FileIdentity&)> opened)
    : opened_(std::move(opened)) {
    current = this;
}

InputRecord::~InputRecord() {
    current = nullptr;
}

void InputRecord::note(InputUse::Kind kind, const std::filesystem::path& path,
                       const FileIdentity& identity) {
    InputRecord* record = current;
    if (record == nullptr) return;
    // A scene can contain such a name, but no file can have it.
    if (path.native().find('\0') != std::string::npos) return;
    const std::lock_guard lock(record->mutex_);
    const bool is_new = record->uses_.insert({kind, path, identity}).second;
    if (is_new && kind == InputUse::File && record->opened_) record->opened_(identity);
}

std::vector<InputUse> InputRecord::uses() const {
    const std::lock_guard lock(mutex_);
    return {uses_.begin(), uses_.end()};
}

}  // namespace dollytrack
