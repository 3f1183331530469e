#include "engine/io/assimp/collada_asset.h"
#include "engine/io/assimp/model_text_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    EXPECT_TRUE(
        parseColladaAsset("<authoring_tool>SketchUp 14.0.4900</authoring_tool>").by_sketchup);
    EXPECT_TRUE(parseColladaAsset("<authoring_tool>Google SketchUp 8").by_sketchup);
    EXPECT_FALSE(parseColladaAsset("<authoring_tool>Blender</authoring_tool>SketchUp").by_sketchup);
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

std::string mendedCounts(const std::string& collada) {
    std::vector<std::uint8_t> text(collada.begin(), collada.end());
    static_cast<void>(mendArrayCounts(text));
    return {text.begin(), text.end()};
}

TEST(ColladaCounts, AreThoseOfTheValues) {
    const auto source = [](const std::string& array_count, const std::string& accessor) {
        return "<source><float_array id=\"a\" count=\"" + array_count +
               "\"> 1 2 3\n4 5 6 </float_array><accessor source=\"#a\" " + accessor +
               "><param name=\"X\"/><param/><param/></accessor></source>";
    };
    const std::string right = source("6", "count=\"2\" stride=\"3\"");
    EXPECT_EQ(mendedCounts(right), right);
    // LeoCAD counts vertices; others may count too much.
    for (const std::string wrong : {"2", "7", "4294967296000", "-1", "x", ""}) {
        EXPECT_EQ(mendedCounts(source(wrong, "count=\"2\" stride=\"3\"")), right) << wrong;
    }
    // Accessors end with their arrays.
    for (const std::string wrong : {"3", "99999999999999999999", "-1"}) {
        EXPECT_EQ(mendedCounts(source("6", "count=\"" + wrong + "\" stride=\"3\"")), right)
            << wrong;
    }
    EXPECT_EQ(mendedCounts(source("6", "count=\"2\" offset=\"1\" stride=\"3\"")),
              source("6", "count=\"1\" offset=\"1\" stride=\"3\""));
    EXPECT_EQ(mendedCounts(source("6", "count='6' offset='5'")),
              source("6", "count='0' offset='5'"));
    // Three parameters with a stride of 1 overlap.
    EXPECT_EQ(mendedCounts(source("6", "count='6'")), source("6", "count='4'"));
    EXPECT_EQ(mendedCounts(source("6", "count='2' offset='18446744073709551615' stride='3'")),
              source("6", "count='0' offset='18446744073709551615' stride='3'"));
    EXPECT_EQ(mendedCounts(source("6", "name=\" count='2' \" count=\"9\" stride=\"3\"")),
              source("6", "name=\" count='2' \" count=\"2\" stride=\"3\""));
    // assimp may know an array that is not found here.
    EXPECT_EQ(mendedCounts("<accessor source='&#35;a' count='3'/>"),
              "<accessor source='&#35;a' count='0'/>");
    for (const std::string nothing : {"<float_array count='2'", "<float_array/>", "<accessor", "",
                                      "<!-- <float_array count='2'>1</float_array> -->"}) {
        EXPECT_EQ(mendedCounts(nothing), nothing) << nothing;
    }
}

TEST(ColladaCounts, ReadLargeTextsOnce) {
    std::string tags;
    while (tags.size() < 2'000'000)
        tags += "<accessor source='#a' count='1'/><float_array id='a'/>";
    EXPECT_NE(mendedCounts(tags), tags);
}

TEST(ColladaIndices, NamesTheLineOfAListThatIsNotOfWholeNumbers) {
    const auto inTriangles = [](const std::string& list) {
        return lineOfBadIndices("<COLLADA>\n<triangles count=\"1\">\n" + list + "</triangles>");
    };
    for (const std::string sound :
         {"<p>0 1 2</p>", "<p>0 1\n2</p>", "<p>+0 -1\t2</p>", "<p/>", "<p></p>",
          "<p id=\"x\">3</p>", "<!-- <p>x</p> --><p>1</p>", "<phong>x</phong>",
          "<![CDATA[<p>x</p>]]><p>1</p>", "<p id='>' >3</p >"}) {
        EXPECT_EQ(inTriangles(sound), 0U) << sound;
    }
    for (const std::string bad :
         {"<p>0 1e999 2</p>", "<p>0 %n 2</p>", "<p>1.5</p>", "<p id=\"x\">a</p>", "<p>1,2</p>"}) {
        EXPECT_EQ(inTriangles(bad), 3U) << bad;
    }
    // Other elements may be named <p>, too.
    EXPECT_EQ(lineOfBadIndices("<extra><p>text</p></extra>"), 0U);
    EXPECT_EQ(lineOfBadIndices("<lines><p>1</p></lines><p>text</p>"), 0U);
    EXPECT_EQ(lineOfBadIndices("<triangles><p>1"), 0U);
    EXPECT_EQ(lineOfBadIndices("<triangles><!-- <p>x"), 0U);
    EXPECT_EQ(lineOfBadIndices("<triangles><p"), 0U);
}

TEST(ColladaIndices, FindsListsBehindOtherMarkup) {
    const auto inTriangles = [](const std::string& list) {
        return lineOfBadIndices("<triangles>\n" + list + "</triangles>");
    };
    // Without the markup, assimp would read "x" as the list.
    for (const std::string bad :
         {"<p><!-- c -->x</p>", "<p><![CDATA[x]]></p>", "<p>1<?x?></p>", "<p id='/>'>x</p>",
          "<q id='<!--'/><p>x</p>", "<![CDATA[<!--]]><p>x</p>", "<?q <!-- ?><p>x</p>",
          "<lines></lines><p>x</p>", "<lines/><p>x</p>", "<q id='</triangles>'/><p>x</p>"}) {
        EXPECT_EQ(inTriangles(bad), 2U) << bad;
    }
    EXPECT_EQ(lineOfBadIndices("<!DOCTYPE a [<!-- ' -->]><lines><p>x</p><q id=''/></lines>"), 1U);
    EXPECT_EQ(lineOfBadIndices("<triangles/><p>text</p>"), 0U);
    EXPECT_EQ(lineOfBadIndices("<triangles count='1' /><p>text</p>"), 0U);
    EXPECT_EQ(lineOfBadIndices("<triangles><p>1</p></triangles ><p>text</p>"), 0U);
}

TEST(ColladaIndices, ReadsLargeTextsOnce) {
    constexpr std::size_t kLength = 2'000'000;
    EXPECT_EQ(lineOfBadIndices(std::string(kLength, '<')), 0U);
    std::string tags = "<lines>";
    while (tags.size() < kLength) tags += "<x>\n";
    const auto lines = static_cast<std::size_t>(std::count(tags.begin(), tags.end(), '\n'));
    EXPECT_EQ(lineOfBadIndices(tags), 0U);
    EXPECT_EQ(lineOfBadIndices(tags + "<p>x</p>"), lines + 1);
}

}  // namespace
}  // namespace dollytrack::collada_asset_test
