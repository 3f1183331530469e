#include "engine/io/assimp/collada_asset.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dollytrack::collada_asset_test {
namespace {

TEST(ColladaAsset, ReadsUnitAndUpAxis) {
    const ColladaAsset asset = parseColladaAsset(
        "<asset><unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>");
    EXPECT_EQ(asset.unit_m, 0.01);
    EXPECT_EQ(asset.up_axis, 'z');
    EXPECT_EQ(parseColladaAsset("<unit meter = ' 2.54e-2' name='inch'>").unit_m, 0.0254);
    EXPECT_EQ(parseColladaAsset("<up_axis> X_UP").up_axis, 'x');
}

TEST(ColladaAsset, KeepsDefaultsForWhatIsNoNumber) {
    for (const std::string value : {"", "-1", "0", "nan", "inf", "x", "1e999"}) {
        EXPECT_EQ(parseColladaAsset("<unit meter=\"" + value + "\"/>").unit_m, 1.0) << value;
    }
    EXPECT_EQ(parseColladaAsset("<unit/>").unit_m, 1.0);
    EXPECT_EQ(parseColladaAsset("<unit meter/>").unit_m, 1.0);
    EXPECT_EQ(parseColladaAsset("<unit name=\"m\"/><x meter=\"3\"/>").unit_m, 1.0);
    EXPECT_EQ(parseColladaAsset("").up_axis, 'y');
}

TEST(ColladaAsset, ReadsNothingBeyondACut) {
    const std::string text = "<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>";
    for (std::size_t length = 0; length < text.size(); ++length) {
        // A separate allocation, so that the sanitizer detects reads past its end.
        const std::vector<char> head(text.begin(),
                                     text.begin() + static_cast<std::ptrdiff_t>(length));
        const ColladaAsset asset = parseColladaAsset({head.data(), head.size()});
        EXPECT_EQ(asset.unit_m, length < 20 ? 1.0 : 0.01) << length;
        EXPECT_EQ(asset.up_axis, length < 30 ? 'y' : 'z') << length;
    }
}

}  // namespace
}  // namespace dollytrack::collada_asset_test
