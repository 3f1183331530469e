#include "app/view/page_files.h"

#include <string_view>

namespace dollytrack {

// Generated from assets/view at build time; see app/CMakeLists.txt.
extern const char* const kViewPage;
extern const char* const kViewStyle;
extern const char* const kViewPageData;
extern const char* const kViewPageState;
extern const char* const kViewRoom;
extern const char* const kViewTrajectory;
extern const char* const kViewBoxes;
extern const char* const kViewView3d;
extern const char* const kViewPicking;
extern const char* const kViewPicture;
extern const char* const kViewObjectList;
extern const char* const kViewTimeline;

namespace view {

const PageFiles& pageFiles() {
    static const PageFiles files = [] {
        constexpr std::string_view kStylePlace = "/* STYLE */";
        constexpr std::string_view kDataPlace = "<!-- DATA -->\n";
        const std::string page = kViewPage;
        const std::size_t style = page.find(kStylePlace);
        const std::size_t data = page.find(kDataPlace);
        PageFiles made;
        made.head = page.substr(0, style) + kViewStyle +
                    page.substr(style + kStylePlace.size(), data - style - kStylePlace.size());
        made.end = page.substr(data + kDataPlace.size());
        for (const char* script :
             {kViewPageData, kViewPageState, kViewRoom, kViewTrajectory, kViewBoxes, kViewView3d,
              kViewPicking, kViewPicture, kViewObjectList, kViewTimeline}) {
            made.script += script;
        }
        return made;
    }();
    return files;
}

}  // namespace view
}  // namespace dollytrack
