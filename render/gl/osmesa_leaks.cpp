// Mesa keeps a few kilobytes of every OSMesa context for good. Under AddressSanitizer that must not
// hide our own leaks, so only blocks allocated by the library itself are excused.

#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __lsan_default_suppressions();  // NOLINT: the sanitizer's own name
extern "C" [[gnu::visibility("default")]] const char* __lsan_default_suppressions() {
    return "leak:libOSMesa\nleak:libLLVM\n";
}
#endif
