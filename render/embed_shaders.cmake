# Turns the shader files into one C++ source: cmake -DOUT=... -DFOLDER=... -DNAMES=a;b -P this
set(TEXT "#include \"render/gl/shader.h\"\n\nnamespace dollytrack::gl {\n\n")
string(APPEND TEXT "std::string_view shaderSource(std::string_view name) {\n")
foreach(NAME ${NAMES})
    file(READ "${FOLDER}/${NAME}" SOURCE)
    string(APPEND TEXT "    if (name == \"${NAME}\") {\n        return R\"glsl(${SOURCE})glsl\";\n    }\n")
endforeach()
string(APPEND TEXT "    return {};\n}\n\n}  // namespace dollytrack::gl\n")
file(WRITE "${OUT}" "${TEXT}")
