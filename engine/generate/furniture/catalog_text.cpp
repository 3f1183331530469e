#include "engine/generate/furniture/catalog_text.h"

#include "engine/core/clean_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

namespace dollytrack::generate {
namespace {

void appendUtf8(std::string& text, unsigned code) {
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | code >> 6U);
        text += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
        text += static_cast<char>(0xE0U | code >> 12U);
        text += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
        text += static_cast<char>(0x80U | (code & 0x3FU));
    }
}

constexpr double kLargestPiece = 10'000.0;  // cm

/// A value as UTF-8. Its bytes are Latin-1, and other characters are escaped ("\u00e9").
std::string unescaped(std::string_view value) {
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i) {
        unsigned code = static_cast<unsigned char>(value[i]);
        if (code == '\\' && i + 1 < value.size()) {
            ++i;
            code = static_cast<unsigned char>(value[i]);
            unsigned point = 0;
            if (code == 'u' && i + 4 < value.size() &&
                std::from_chars(&value[i + 1], &value[i + 1] + 4, point, 16).ptr ==
                    &value[i + 1] + 4) {
                code = point;
                i += 4;
            }
        }
        appendUtf8(text, code);
    }
    return cleanText(text);
}

double number(const std::string& text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::isfinite(value) ? value : 0.0;
}

std::optional<Eigen::Matrix3d> matrix(const std::string& text) {
    Eigen::Matrix3d result;
    const char* at = text.data();
    const char* end = at + text.size();
    for (int i = 0; i < 9; ++i) {
        while (at < end && *at == ' ') ++at;
        double value = 0.0;
        const auto [next, status] = std::from_chars(at, end, value);
        if (status != std::errc{}) return std::nullopt;
        result(i / 3, i % 3) = value;
        at = next;
    }
    return result;
}

using Entry = std::map<std::string, std::string>;

CatalogPiece pieceOf(Entry& entry) {
    CatalogPiece piece;
    piece.id = entry["id"];
    piece.name = entry["name"];
    piece.category = entry["category"];
    piece.model = entry["model"];
    piece.model.erase(0, piece.model.find_first_not_of('/'));
    piece.creator = entry["creator"];
    piece.width = number(entry["width"]);
    piece.depth = number(entry["depth"]);
    piece.height = number(entry["height"]);
    piece.elevation = number(entry["elevation"]);
    piece.opening = entry["doorOrWindow"] == "true";
    piece.cut_out = entry["doorOrWindowCutOutShape"];
    piece.model_rotation = matrix(entry["modelRotation"]);
    return piece;
}

bool isUsable(const CatalogPiece& piece) {
    const auto fits = [](double size) { return size > 0.0 && size < kLargestPiece; };
    return fits(piece.width) && fits(piece.depth) && fits(piece.height) && !piece.model.empty();
}

}  // namespace

CatalogText parseCatalog(std::string_view text) {
    std::map<int, Entry> entries;  // by number; 0: keys of the library itself
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(text.substr(at, end - at));
        at = end + 1;
        const auto equals = line.find('=');
        if (line.empty() || line.front() == '#' || equals == std::string_view::npos) continue;
        const std::string_view key = trimmed(line.substr(0, equals));
        const auto hash = key.find('#');
        int index = 0;
        if (hash != std::string_view::npos) {
            std::from_chars(key.data() + hash + 1, key.data() + key.size(), index);
            if (index < 1) continue;
        }
        entries[index][std::string(key.substr(0, hash))] =
            unescaped(trimmed(line.substr(equals + 1)));
    }
    CatalogText catalog;
    catalog.name = entries[0]["name"];
    catalog.license = entries[0]["license"];
    entries.erase(0);
    for (auto& [index, entry] : entries) {
        CatalogPiece piece = pieceOf(entry);
        piece.license = catalog.license;
        piece.library = catalog.name;
        if (isUsable(piece)) catalog.pieces.push_back(std::move(piece));
    }
    return catalog;
}

}  // namespace dollytrack::generate
