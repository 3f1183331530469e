#pragma once

#include "engine/core/result.h"
#include "engine/io/homes/home.h"

#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Parses Home.xml (Sweet Home 3D 5.3 and later; its DTD is SweetHome3D.dtd). Unknown elements are
/// ignored. Error: BadInput, for damaged XML, another root element, a document type declaration
/// (entities are not needed and unsafe) or an invalid number.
Result<Home> parseHomeXml(std::string_view text, const std::string& where);

}  // namespace dollytrack::homes
