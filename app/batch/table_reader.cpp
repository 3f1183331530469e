#include "app/batch/table_reader.h"

#include "engine/core/field_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::batch {

TableReader::TableReader(const toml::table& table, std::string file)
    : table_(table), file_(std::move(file)) {}

const toml::node* TableReader::find(const char* key) {
    known_.emplace_back(key);
    return table_.get(key);
}

std::string TableReader::placeOf(const toml::node& node) const {
    return fmt::format("{}:{}", file_, node.source().begin.line);
}

std::string TableReader::placeOf(const char* key) const {
    const toml::node* node = table_.get(key);
    return placeOf(node != nullptr ? *node : static_cast<const toml::node&>(table_));
}

void TableReader::refuse(const std::string& where, std::string message) {
    if (!error_) error_ = Error{ErrorCode::BadInput, std::move(message), where};
}

void TableReader::wants(const toml::node& node, const char* key, const std::string& what) {
    refuse(placeOf(node), fmt::format("'{}' must be {}.", key, what));
}

void TableReader::read(const char* key, std::string& target) {
    std::optional<std::string> value;
    read(key, value);
    if (value) target = std::move(*value);
}

void TableReader::read(const char* key, std::optional<std::string>& target) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    target = node->value_exact<std::string>();
    if (!target || target->empty()) wants(*node, key, "a text in quotes");
}

void TableReader::read(const char* key, std::optional<double>& target, double low, double high) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    target = node->value<double>();  // accepts integers
    if (node->is_number() && *target >= low && *target <= high) return;
    wants(*node, key, fmt::format("a number, {} to {}", low, high));
}

void TableReader::read(const char* key, std::optional<int>& target, int low, int high) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < low || *value > high) {
        return wants(*node, key, fmt::format("a whole number, {} to {}", low, high));
    }
    target = static_cast<int>(*value);
}

void TableReader::read(const char* key, bool& target) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const auto value = node->value_exact<bool>();
    if (!value) return wants(*node, key, "true or false");
    target = *value;
}

void TableReader::read(const char* key, std::vector<Placed<std::string>>& target) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const auto add = [&](const toml::node& one) {
        const auto text = one.value_exact<std::string>();
        if (!text || text->empty()) return wants(one, key, "a list of texts in quotes");
        target.push_back({*text, placeOf(one)});
    };
    if (const toml::array* list = node->as_array()) {
        for (const toml::node& one : *list) add(one);
        if (list->empty()) wants(*node, key, "a list that is not empty, or be left out");
    } else {
        add(*node);
    }
}

void TableReader::read(const char* key, std::vector<int>& target, int low, int high) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const std::string what = fmt::format("a list of whole numbers, {} to {}", low, high);
    const toml::array* list = node->as_array();
    if (list == nullptr || list->empty()) return wants(*node, key, what);
    for (const toml::node& one : *list) {
        const auto value = one.value_exact<std::int64_t>();
        if (!value || *value < low || *value > high) return wants(one, key, what);
        const auto number = static_cast<int>(*value);
        if (std::find(target.begin(), target.end(), number) != target.end()) {
            return refuse(placeOf(one), fmt::format("'{}' has {} twice.", key, number));
        }
        target.push_back(number);
    }
}

const toml::table* TableReader::table(const char* key) {
    const toml::node* node = find(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) wants(*node, key, fmt::format("a table, begun with [{}]", key));
    return node->as_table();
}

std::vector<const toml::table*> TableReader::tables(const char* key) {
    std::vector<const toml::table*> found;
    const toml::node* node = find(key);
    if (node == nullptr) return found;
    const std::string what = fmt::format("a table of a list, begun with [[{}]]", key);
    const toml::array* list = node->as_array();
    if (list == nullptr) {
        wants(*node, key, what);
        return found;
    }
    for (const toml::node& one : *list) {
        if (!one.is_table()) {
            wants(one, key, what);
            break;
        }
        found.push_back(one.as_table());
    }
    return found;
}

Status TableReader::finish() {
    for (const auto& [key, node] : table_) {
        const std::string name(key.str());
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        const std::string close = closestName(name, known_);
        std::string all;
        for (const std::string& one : known_) all += (all.empty() ? "" : ", ") + one;
        refuse(fmt::format("{}:{}", file_, key.source().begin.line),
               close.empty()
                   ? fmt::format("There is no key '{}'; there are {}.", name, all)
                   : fmt::format("There is no key '{}'; did you mean '{}'?", name, close));
        break;
    }
    if (error_) return tl::unexpected(*error_);
    return {};
}

}  // namespace dollytrack::batch
