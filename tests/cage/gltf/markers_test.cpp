// Markers: named times of clips, from the extras of an animation.
#include "cage/clip_set.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>
#include <utility>

namespace supple::cage {
namespace {

using namespace test;
using Times = std::vector<std::pair<std::string, double>>;

Times markersOf(const Clip& clip) {
    Times times;
    for (const Marker& marker : clip.markers) {
        times.emplace_back(marker.name, marker.time);
    }
    return times;
}

/// skinnedQuad(), whose clip of 2 seconds has these extras.
GltfBuilder withExtras(const std::string& extras) {
    GltfBuilder b = skinnedQuad();
    b.more = replaced(b.more, R"("animations":[{)", R"("animations":[{"extras":)" + extras + ",");
    return b;
}

TEST(GltfMarkers, AreSortedByTime) {
    const Character c = readWell(withExtras(
        R"({"mood":3,"markers":[{"name":"right","time":1.5},{"name":"left","time":0.5,"foot":1},{"name":"","time":0},)"
        R"({"name":"again","time":0.5},{"name":"end","time":2}]})"));
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(markersOf(c.clips[0]), (Times{{"", 0.0}, {"left", 0.5}, {"again", 0.5}, {"right", 1.5}, {"end", 2.0}}));
}

TEST(GltfMarkers, MalformedEntriesAreOneWarning) {
    const Character c = readWell(withExtras(
        R"({"markers":[7,{"name":"a","time":1},{"name":"b"},{"name":2,"time":1},{"time":1},{"name":"c","time":"1"},)"
        R"({"name":"d","time":-0.25},{"name":"e","time":2.5},{"name":"f","time":1e300}]})"));
    EXPECT_EQ(c.warnings, Strings{"animation 0 extras markers[0]: not an object; left out, as are 7 more"});
    EXPECT_EQ(markersOf(c.clips[0]), (Times{{"a", 1.0}}));

    const auto warningOf = [](const std::string& entry) {
        const Character read = readWell(withExtras(R"({"markers":[)" + entry + "]}"));
        EXPECT_TRUE(read.clips[0].markers.empty());
        return read.warnings.size() == 1 ? read.warnings[0] : std::to_string(read.warnings.size()) + " warnings";
    };
    const std::string here = "animation 0 extras markers[0]: ";
    EXPECT_EQ(warningOf(R"({"name":2,"time":1})"), here + "name is not a string; left out");
    EXPECT_EQ(warningOf(R"({"name":"a"})"), here + "time is not a finite number; left out");
    EXPECT_EQ(warningOf(R"({"name":"a","time":-0.25})"), here + "time -0.25 is before the clip's beginning; left out");
    EXPECT_EQ(warningOf(R"({"name":"a","time":2.5})"), here + "time 2.5 is behind the clip's end, 2 s; left out");
}

TEST(GltfMarkers, ListsThatAreNoneAreSaidOrSomebodyElses) {
    const Character c = readWell(withExtras(R"({"markers":{"step":1}})"));
    EXPECT_EQ(c.warnings, Strings{"animation 0 extras markers: not an array; ignored"});
    for (const char* extras : {R"("markers")", "[1]", "{}", R"({"markers":null})", "null"}) {
        EXPECT_EQ(readWell(withExtras(extras)).warnings, Strings()) << extras;
    }
}

TEST(GltfMarkers, RoundingMovesNoneOutOfTheClip) {
    GltfBuilder b = withExtras(R"({"markers":[{"name":"end","time":0.3}]})");
    for (size_t k = 0; k < 3; ++k) {
        b.setFloat(kTimes, k, 0.15f * static_cast<float>(k)); // 0.3f is a little more than 0.3
    }
    b.setFloat(kTimes, 2, 0.29999998f);
    const Character c = readWell(b);
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.clips[0].markers.size(), 1u);
    EXPECT_EQ(c.clips[0].markers[0].time, c.clips[0].duration);
}

TEST(GltfMarkers, MoveWithAClipThatBeginsBeforeZero) {
    GltfBuilder b = withExtras(R"({"markers":[{"name":"step","time":0.25},{"name":"first","time":-0.5}]})");
    const std::string times = std::to_string(b.addFloats("SCALAR", {-0.5f, 0.25f, 1}));
    b.more = replaced(b.more, R"({"input":5,"output":6})", R"({"input":)" + times + R"(,"output":6})");
    const Character c = readWell(b);
    EXPECT_EQ(c.warnings, Strings{"animation 0: keys before 0; its time begins at its first key, -0.5 s"});
    EXPECT_EQ(markersOf(c.clips[0]), (Times{{"first", 0.0}, {"step", 0.75}}));
}

TEST(GltfMarkers, ClipsOfOtherFilesKeepTheirs) {
    const std::vector<std::byte> clips = withExtras(R"({"markers":[{"name":"step","time":1}]})").glb();
    GltfOptions options = kKeepTriangles;
    options.clipFiles.push_back({.name = "walk.glb", .bytes = clips, .baseDirectory = "", .readFile = nullptr});
    const Character c = readWell(skinnedQuad(), options);
    ASSERT_EQ(c.clips.size(), 2u);
    EXPECT_TRUE(c.clips[0].markers.empty());
    EXPECT_EQ(markersOf(c.clips[1]), (Times{{"step", 1.0}}));
}

} // namespace
} // namespace supple::cage
