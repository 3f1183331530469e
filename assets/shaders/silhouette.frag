#version 450 core
// Marks the pixels that an object covers.

layout(location = 0) out float inside;

void main() {
    inside = 1.0;
}
