#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dollytrack {

/// A checksum that detects accidental damage: two byte strings of one length that differ in a
/// single word never have the same sum. It gives no protection against deliberate changes.
[[nodiscard]] std::uint64_t checksumOf(std::span<const std::uint8_t> bytes);

/// Serializes values one after the other. Without an output it only counts the bytes. A function
/// that passes a struct's members to it also works with BinaryReader.
class BinaryWriter {
  public:
    static constexpr bool kReads = false;

    explicit BinaryWriter(std::uint8_t* out = nullptr) : out_(out) {}

    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void number(const T& value) { bytes(&value, sizeof(T)); }
    void text(const std::string& value) {
        number(std::uint64_t{value.size()});
        bytes(value.data(), value.size());
    }
    template <class T>
    void array(const std::vector<T>& values) {
        number(std::uint64_t{values.size()});
        bytes(values.data(), values.size() * sizeof(T));
    }
    template <class T, class Members>
    void list(const std::vector<T>& values, std::size_t /*least_bytes*/, Members members) {
        number(std::uint64_t{values.size()});
        for (const T& value : values) members(*this, value);
    }
    template <class T, class Members>
    void maybe(const std::optional<T>& value, Members members) {
        number(std::uint8_t{value.has_value()});
        if (value) members(*this, *value);
    }
    void bytes(const void* from, std::size_t size) {
        if (out_ != nullptr && size > 0) std::memcpy(out_ + size_, from, size);
        size_ += size;
    }
    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    std::uint8_t* out_;
    std::size_t size_ = 0;
};

/// Reads what BinaryWriter wrote. Before memory is taken for a list or text, its count is checked
/// against the bytes that are left. After the first error all values read are empty and good() is
/// false.
class BinaryReader {
  public:
    static constexpr bool kReads = true;

    /// `most_bytes` limits the memory that the entries of all lists may take: an entry can be ten
    /// times as large as its serialized bytes.
    explicit BinaryReader(std::span<const std::uint8_t> from,
                          std::size_t most_bytes = std::size_t{1} << 30U)
        : from_(from), most_bytes_(most_bytes) {}

    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void number(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 0;
            bytes(&byte, 1);
            if (byte > 1) refuse();
            value = byte == 1;
        } else {
            bytes(&value, sizeof(T));
        }
    }
    void text(std::string& value) { fill(value); }
    template <class T>
    void array(std::vector<T>& values) {
        fill(values);
    }
    /// `least_bytes`: the smallest serialized size of an entry; a count for which too few bytes are
    /// left is refused.
    template <class T, class Members>
    void list(std::vector<T>& values, std::size_t least_bytes, Members members) {
        std::size_t count = takeCount(least_bytes);
        values.clear();
        if (count > most_bytes_ / sizeof(T)) {
            refuse();
            count = 0;
        }
        most_bytes_ -= count * sizeof(T);
        // Growing copies, but a large reserve for entries that turn out to be missing would cost
        // more.
        values.reserve(std::min<std::size_t>(count, 1U << 16U));
        for (std::size_t i = 0; i < count && good_; ++i) members(*this, values.emplace_back());
    }
    template <class T, class Members>
    void maybe(std::optional<T>& value, Members members) {
        bool there = false;
        number(there);
        value.reset();
        if (there) members(*this, value.emplace());
    }
    void bytes(void* into, std::size_t size) {
        if (size > from_.size()) {
            refuse();
            std::memset(into, 0, size);
            return;
        }
        if (size > 0) std::memcpy(into, from_.data(), size);
        from_ = from_.subspan(size);
    }
    [[nodiscard]] bool good() const { return good_; }
    /// Whether everything was read without an error.
    [[nodiscard]] bool finished() const { return good_ && from_.empty(); }

  private:
    std::size_t takeCount(std::size_t least_bytes) {
        std::uint64_t count = 0;
        number(count);
        if (count <= from_.size() / least_bytes) return static_cast<std::size_t>(count);
        refuse();
        return 0;
    }
    template <class Container>
    void fill(Container& values) {
        using T = typename Container::value_type;
        values.resize(takeCount(sizeof(T)));
        bytes(static_cast<void*>(values.data()), values.size() * sizeof(T));
    }
    void refuse() {
        good_ = false;
        from_ = {};
    }

    std::span<const std::uint8_t> from_;
    std::size_t most_bytes_;
    bool good_ = true;
};

/// Serializes one list; `members` as for BinaryWriter::list().
template <class T, class Members>
[[nodiscard]] std::string listText(const std::vector<T>& values, Members members) {
    BinaryWriter counter;
    counter.list(values, 0, members);
    std::string text(counter.size(), '\0');
    BinaryWriter writer(reinterpret_cast<std::uint8_t*>(text.data()));
    writer.list(values, 0, members);
    return text;
}

/// Reads what listText() wrote. Empty unless the whole text is such a list.
template <class T, class Members>
[[nodiscard]] std::optional<std::vector<T>> parseListText(std::string_view text,
                                                          std::size_t least_bytes,
                                                          Members members) {
    BinaryReader reader({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    std::vector<T> values;
    reader.list(values, least_bytes, members);
    if (!reader.finished()) return std::nullopt;
    return values;
}

}  // namespace dollytrack
