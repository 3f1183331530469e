#version 450 core
// Marks what an object covers.

layout(location = 0) out float inside;

void main() {
    inside = 1.0;
}
