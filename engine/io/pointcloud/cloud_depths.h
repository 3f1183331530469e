#pragma once

#include "engine/io/pointcloud/files/point_cloud.h"
#include "engine/jobs/job.h"

namespace dollytrack {

/// Removes the quantization steps of structured-light depth cameras. These measure disparity in
/// integer steps, so that depths at 4 m are 5 cm apart and walls become stairs. If the cloud is a
/// single image of such a camera (all points are in front of the viewpoint or origin along +z, and
/// inverse depth takes few values), each point is moved along its ray onto the plane through its
/// neighbours within 1.5 steps: least squares in inverse depth, in which planes are linear
/// (Khoshelham and Oude Elberink 2012). Returns the step in 1/m; 0 if the cloud was not changed.
double smoothDepths(PointCloud& cloud_m, const JobContext& job);

}  // namespace dollytrack
