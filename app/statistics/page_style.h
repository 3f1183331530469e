#pragma once

namespace dollytrack::statistics {

/// The style of the page, for light and dark. Classes s0 to s5 are the colours of the datasets
/// (after Okabe and Ito's, which people with colour blindness can tell apart).
extern const char* const kPageStyle;

}  // namespace dollytrack::statistics
