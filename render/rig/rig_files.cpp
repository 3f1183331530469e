#include "render/rig/rig_files.h"

#include "render/dataset/contents/modality.h"

namespace dollytrack::render {

std::string rigFolder(const std::string& camera, const std::string& image) {
    return std::string(kRigModality) + "/" + camera + "/" + image;
}

std::vector<std::string> rigFoldersOf(const std::string& camera) {
    std::vector<std::string> folders = {std::string(kRigModality) + "/" + camera};
    for (const char* const image : kRigImages) folders.push_back(rigFolder(camera, image));
    return folders;
}

std::vector<std::string> rigFolders(const Rig& rig) {
    std::vector<std::string> folders;
    for (const RigCamera& camera : rig) {
        for (std::string& one : rigFoldersOf(camera.name)) folders.push_back(std::move(one));
    }
    return folders;
}

}  // namespace dollytrack::render
