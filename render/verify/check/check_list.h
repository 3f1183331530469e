#pragma once

#include "render/verify/compare/check.h"

namespace dollytrack::verify {

// The `begin` function of each check, one file each: check_files.cpp and so on.
CheckWork beginFiles(const Subject& subject, Findings& findings);
CheckWork beginCard(const Subject& subject, Findings& findings);
CheckWork beginImages(const Subject& subject, Findings& findings);
CheckWork beginClasses(const Subject& subject, Findings& findings);
CheckWork beginHoles(const Subject& subject, Findings& findings);
CheckWork beginUsable(const Subject& subject, Findings& findings);
CheckWork beginPictures(const Subject& subject, Findings& findings);
CheckWork beginObjectBoxes(const Subject& subject, Findings& findings);
CheckWork beginCaptures(const Subject& subject, Findings& findings);
CheckWork beginScene(const Subject& subject, Findings& findings);
CheckWork beginSurface(const Subject& subject, Findings& findings);
CheckWork beginCoco(const Subject& subject, Findings& findings);
CheckWork beginPoses(const Subject& subject, Findings& findings);
CheckWork beginMotion(const Subject& subject, Findings& findings);
CheckWork beginFrames(const Subject& subject, Findings& findings);
CheckWork beginImu(const Subject& subject, Findings& findings);
CheckWork beginExactDepth(const Subject& subject, Findings& findings);
CheckWork beginNormals(const Subject& subject, Findings& findings);
CheckWork beginObjectCoordinates(const Subject& subject, Findings& findings);
CheckWork beginFlow(const Subject& subject, Findings& findings);
CheckWork beginSceneFlow(const Subject& subject, Findings& findings);
CheckWork beginTracks(const Subject& subject, Findings& findings);
CheckWork beginStereo(const Subject& subject, Findings& findings);
CheckWork beginAmodal(const Subject& subject, Findings& findings);
CheckWork beginInstances(const Subject& subject, Findings& findings);
CheckWork beginYolo(const Subject& subject, Findings& findings);
CheckWork beginBop(const Subject& subject, Findings& findings);
CheckWork beginGltf(const Subject& subject, Findings& findings);
CheckWork beginColmap(const Subject& subject, Findings& findings);
CheckWork beginTransforms(const Subject& subject, Findings& findings);
CheckWork beginCameraJson(const Subject& subject, Findings& findings);
CheckWork beginTum(const Subject& subject, Findings& findings);
CheckWork beginKitti(const Subject& subject, Findings& findings);
CheckWork beginKittiObjects(const Subject& subject, Findings& findings);
CheckWork beginHdf5(const Subject& subject, Findings& findings);
CheckWork beginCocoPolygons(const Subject& subject, Findings& findings);
CheckWork beginFolds(const Subject& subject, Findings& findings);
CheckWork beginVideo(const Subject& subject, Findings& findings);
CheckWork beginAlbedo(const Subject& subject, Findings& findings);
CheckWork beginMaterials(const Subject& subject, Findings& findings);
CheckWork beginLight(const Subject& subject, Findings& findings);
CheckWork beginRgbSensor(const Subject& subject, Findings& findings);
CheckWork beginDepthSensor(const Subject& subject, Findings& findings);
CheckWork beginTartanAir(const Subject& subject, Findings& findings);
CheckWork beginEuroc(const Subject& subject, Findings& findings);
/// Checks the images and poses of a rig's cameras; see stored_rig.h.
CheckWork beginCameras(const Subject& subject, Findings& findings);

}  // namespace dollytrack::verify
