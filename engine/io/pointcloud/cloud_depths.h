#pragma once

#include "engine/io/pointcloud/point_cloud.h"
#include "engine/jobs/job.h"

namespace dollytrack::io {

/// Depth cameras of structured light measure disparity in whole steps: at 4 m their depths are 5 cm
/// apart, and walls become stairs. Where a cloud is one picture of such a camera (its z axis looks
/// forward from the viewpoint, or from the origin, and inverse depths take few values), every
/// point is moved along its ray onto the plane through its neighbours: least squares in inverse
/// depth, in which planes are linear (Khoshelham and Oude Elberink 2012), over those within one and
/// a half steps. Returns the step, 1/m; 0 where the cloud is no such picture and stays as it is.
double smoothDepths(PointCloud& cloud_m, const JobContext& job);

}  // namespace dollytrack::io
