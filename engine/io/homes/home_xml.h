#pragma once

#include "engine/core/result.h"
#include "engine/io/homes/home.h"

#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Reads Home.xml (Sweet Home 3D 5.3 and later; its DTD is SweetHome3D.dtd). BadInput, with what is
/// wrong where, for text that is no XML, another document, one with a document type (entities are
/// never needed) or with numbers that are none; unknown elements are passed over.
Result<Home> parseHomeXml(std::string_view text, const std::string& where);

}  // namespace dollytrack::homes
