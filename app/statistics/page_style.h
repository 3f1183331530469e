#pragma once

namespace dollytrack::statistics {

/// The style of the page, for light and dark. Classes s0 to s5 are the colours of the datasets
/// (which people with any kind of colour blindness can tell apart).
extern const char* const kPageStyle;

}  // namespace dollytrack::statistics
