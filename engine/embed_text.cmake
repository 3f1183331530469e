# Writes a text file as a C++ string: cmake -DINPUT=... -DOUTPUT=... -DSYMBOL=... -P embed_text.cmake
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}.new" "namespace dollytrack {
extern const char* const ${SYMBOL};
const char* const ${SYMBOL} = R\"embedded(${text})embedded\";
}  // namespace dollytrack
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
