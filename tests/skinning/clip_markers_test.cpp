// Which markers playback passes: every one exactly once, however the interval is cut, in both directions, over the end
// of looping clips.
#include "skinning/clip_markers.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace supple::skinning {
namespace {

cage::Clip clipWith(double duration, const std::vector<double>& times) {
    cage::Clip clip;
    clip.duration = duration;
    for (const double time : times) {
        clip.markers.push_back({"m", time});
    }
    return clip;
}

/// "1@0.5 0@1": marker 1 at 0.5, marker 0 at 1
std::string passed(const cage::Clip& clip, const MarkerInterval& interval) {
    std::vector<PassedMarker> markers(100);
    const uint64_t count = markersBetween(clip, interval, markers);
    std::string text;
    for (uint64_t i = 0; i < count; ++i) {
        char one[64];
        std::snprintf(one, sizeof one, "%s%u@%g", i == 0 ? "" : " ", markers[i].marker, markers[i].time);
        text += one;
    }
    return text;
}

const cage::Clip kStep = clipWith(2.0, {0.0, 0.5, 2.0});

TEST(ClipMarkers, Once) {
    EXPECT_EQ(passed(kStep, {0.0, 0.5}), "1@0.5");
    EXPECT_EQ(passed(kStep, {0.5, 2.0}), "2@2");
    EXPECT_EQ(passed(kStep, {-1.0, 9.0}), "0@0 1@0.5 2@2");
    EXPECT_EQ(passed(kStep, {2.0, 9.0}), "");
    EXPECT_EQ(passed(kStep, {0.5, 0.5}), "");
    EXPECT_EQ(passed(kStep, {0.0, 0.5, false, true}), "0@0 1@0.5") << "playback starts";
    EXPECT_EQ(passed(kStep, {0.5, 0.5, false, true}), "1@0.5");
}

TEST(ClipMarkers, Backwards) {
    EXPECT_EQ(passed(kStep, {9.0, -1.0}), "2@2 1@0.5 0@0");
    EXPECT_EQ(passed(kStep, {2.0, 0.5}), "1@0.5") << "the one at 2 was met on the way there";
    EXPECT_EQ(passed(kStep, {2.0, 0.5, false, true}), "2@2 1@0.5");
    EXPECT_EQ(passed(kStep, {0.5, 0.0}), "0@0");
}

TEST(ClipMarkers, Looping) {
    EXPECT_EQ(passed(kStep, {0.0, 2.0, true}), "1@0.5 2@2 0@2") << "the end of a pass is the start of the next";
    EXPECT_EQ(passed(kStep, {1.0, 6.5, true}), "2@2 0@2 1@2.5 2@4 0@4 1@4.5 2@6 0@6 1@6.5");
    EXPECT_EQ(passed(kStep, {-1.6, 0.4, true}), "1@-1.5 2@0 0@0");
    EXPECT_EQ(passed(kStep, {2.5, -0.1, true}), "0@2 2@2 1@0.5 0@0 2@0");
    EXPECT_EQ(passed(kStep, {0.0, 0.1, true, true}), "0@0") << "the pass before was not played";
    EXPECT_EQ(passed(kStep, {4.0, 4.5, true, true}), "0@4 1@4.5");
    EXPECT_EQ(passed(kStep, {4.0, 3.9, true, true}), "2@4") << "backwards: nor was the one behind";
    EXPECT_EQ(passed(kStep, {0.5, 0.5, true, true}), "1@0.5");
}

TEST(ClipMarkers, ClipsWithoutDurationOrMarkers) {
    EXPECT_EQ(passed(clipWith(0.0, {0.0}), {-1.0, 5.0, true}), "0@0");
    EXPECT_EQ(passed(clipWith(0.0, {0.0}), {0.0, 5.0, true, true}), "0@0");
    EXPECT_EQ(passed(clipWith(2.0, {}), {-100.0, 100.0, true, true}), "");
}

TEST(ClipMarkers, LongIntervalsAreCountedAndCut) {
    std::vector<PassedMarker> first(4);
    const uint64_t count = markersBetween(clipWith(1e-6, {0.0, 5e-7}), {-1e9, 1e9, true}, first);
    EXPECT_NEAR(static_cast<double>(count), 4e15, 2.0);
    EXPECT_NEAR(first[3].time, -1e9 + 2e-6, 2e-6);
    EXPECT_EQ(markersBetween(kStep, {0.0, 2e6, true}, {}), 3000000u);
}

/// Cuts playback into frames of random lengths, some of them backwards, and counts how often each marker is met.
TEST(ClipMarkers, EveryMarkerIsMetOncePerPassing) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int run = 0; run < 200; ++run) {
        const double duration = run % 3 == 0 ? 0.1 : 0.1 + unit(random);
        std::vector<double> times{0.0, duration, 0.3 * duration, std::nextafter(duration, 0.0)};
        for (int extra = 0; extra < run % 5; ++extra) {
            times.push_back(duration * unit(random));
        }
        std::sort(times.begin(), times.end());
        const cage::Clip clip = clipWith(duration, times);
        const double end = 7.35 * duration;
        const uint64_t whole = markersBetween(clip, {0.0, end, true, true}, {});
        uint64_t cut = 0;
        double now = 0.0, last = -std::numeric_limits<double>::infinity();
        bool start = true;
        std::vector<PassedMarker> out(64);
        while (now < end) {
            // Frames that end on markers and on ends of passes are the hard ones.
            double next = std::min(end, now + 0.4 * duration * unit(random));
            if (unit(random) < 0.3) {
                next = std::min(end, std::max(now, std::ceil(now / duration) * duration));
            }
            const uint64_t count = markersBetween(clip, {now, next, true, start}, out);
            for (uint64_t i = 0; i < count; ++i) {
                EXPECT_GE(out[i].time, last);
                last = out[i].time;
            }
            cut += count;
            start = false;
            now = next;
        }
        EXPECT_EQ(cut, whole) << "run " << run;
        // The way back meets them all again, but for those at the very end.
        const uint64_t back = markersBetween(clip, {end, 0.0, true, true}, {});
        EXPECT_EQ(markersBetween(clip, {end, 0.1 * duration, true}, {}) +
                      markersBetween(clip, {0.1 * duration, 0.0, true}, {}),
                  markersBetween(clip, {end, 0.0, true}, {}));
        EXPECT_EQ(back, whole + 1) << "the way back ends with the end of the pass before 0";
    }
}

} // namespace
} // namespace supple::skinning
