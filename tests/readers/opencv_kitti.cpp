// Reads a folder in the layout of KITTI's odometry with OpenCV's reader and prints its contents as
// JSON.
#include <nlohmann/json.hpp>
#include <opencv2/datasets/slam_kitti.hpp>

#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: opencv_kitti FOLDER/\n";
        return 2;
    }
    const cv::Ptr<cv::datasets::SLAM_kitti> dataset = cv::datasets::SLAM_kitti::create();
    dataset->load(argv[1]);
    nlohmann::json sequences = nlohmann::json::array();
    for (const cv::Ptr<cv::datasets::Object>& object : dataset->getTrain()) {
        const auto& sequence = static_cast<const cv::datasets::SLAM_kittiObj&>(*object);
        nlohmann::json poses = nlohmann::json::array();
        for (const cv::datasets::pose& pose : sequence.posesArray) poses.push_back(pose.elem);
        sequences.push_back({{"name", sequence.name},
                             {"images", sequence.images},
                             {"projections", sequence.p},
                             {"times", sequence.times},
                             {"poses", poses}});
    }
    std::cout << sequences.dump() << "\n";
}
