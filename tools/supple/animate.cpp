#include "tools/supple/animate.h"

#include "tools/common/figure_file.h"
#include "tools/supple/command.h"
#include "tools/supple/output_files.h"
#include "tools/supple/progress.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/webp_animation.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

namespace {

constexpr float kAnimateMargin = 0.07f;
constexpr uint32_t kFramedPoses = 9; ///< of the clip, for the camera to hold
constexpr double kStillSeconds = 4.0;
constexpr double kSecondsBehind = 1.0; ///< a transition

/// The frames one by one into what the output's name asks for.
class FrameOutput {
public:
    [[nodiscard]] static Result<FrameOutput> open(const AnimateOptions& options, VkExtent2D size) {
        FrameOutput output(options);
        if (!options.output.ends_with(".webp"))
            return output;
        Result<std::unique_ptr<WebpAnimation>> webp = WebpAnimation::create(size.width, size.height, options.quality);
        if (!webp)
            return webp.error();
        output.webp_ = std::move(*webp);
        return output;
    }
    [[nodiscard]] Status add(const host::Picture& picture) {
        const uint32_t frame = count_++;
        return webp_ ? webp_->add(picture, startOf(frame)) : host::writePng(picture, frameFile(options_.output, frame));
    }
    [[nodiscard]] Status finish() { return webp_ ? webp_->write(startOf(count_), options_.output) : success(); }

private:
    explicit FrameOutput(const AnimateOptions& options) : options_(options) {}
    [[nodiscard]] int startOf(uint32_t frame) const {
        return static_cast<int>(std::lround(1e3 * frame / options_.fps));
    }

    const AnimateOptions& options_;
    std::unique_ptr<WebpAnimation> webp_;
    uint32_t count_ = 0;
};

Result<uint32_t> clipOf(const host::Figure& figure, const std::string& name) {
    if (name.empty())
        return figure.clips().empty() ? SUPPLE_REST_POSE : 0u;
    return host::findClip(figure, name);
}

/// What is shown, and for how long.
struct Course {
    uint32_t clip = SUPPLE_REST_POSE;
    std::optional<host::PlannedTransition> transition;
    double seconds = kStillSeconds;
    double loop = 0.0; ///< 0: none

    double simulate = 0.0; ///< seconds before the first frame; 0: nothing swings

    [[nodiscard]] ClipTime at(double time) const {
        return {clip, loop > 0.0 && simulate == 0.0 ? std::fmod(time, loop) : time, transition, {}};
    }
    /// Springs go on from the frame before.
    [[nodiscard]] ClipTime frame(uint32_t number, double fps) const {
        ClipTime shown = at(number / fps);
        shown.since = number == 0 ? -simulate : (number - 1) / fps;
        return shown;
    }
    /// Poses that the camera has to hold.
    [[nodiscard]] std::vector<ClipTime> framed(const host::Figure& figure) const {
        std::vector<ClipTime> poses;
        for (uint32_t i = 0; transition && i < kFramedPoses; ++i)
            poses.push_back(at(seconds * i / (kFramedPoses - 1)));
        return transition ? poses : spreadTimes(figure, clip, kFramedPoses);
    }
};

Result<Course> courseOf(const Stage& stage, const AnimateOptions& options) {
    Course course;
    const Result<std::optional<host::PlannedTransition>> transition = stage.transition();
    const Result<uint32_t> clip = clipOf(stage.figure(), options.clip);
    if (!transition || !clip)
        return !transition ? transition.error() : clip.error();
    course.clip = *clip;
    course.transition = *transition;
    course.simulate = options.draw.simulate;
    if (course.transition) {
        course.seconds = course.transition->at + course.transition->seconds + kSecondsBehind;
    } else {
        course.loop = stage.figure().clipDuration(*clip);
        course.seconds = course.loop > 0.0 ? course.loop : kStillSeconds;
    }
    course.seconds = options.seconds > 0.0 ? options.seconds : course.seconds;
    return course;
}

/// One camera for all frames, which holds all poses.
Result<host::Scene> sceneOf(Stage& stage, const AnimateOptions& options, const Course& course, VkExtent2D size,
                            uint32_t view) {
    Result<Extent> extent = stage.measure(course.framed(stage.figure()), options.draw.scheme == "cage");
    if (!extent)
        return extent.error();
    const float aspect =
        static_cast<float>(size.width) / static_cast<float>(size.height) * (options.draw.split ? 0.5f : 1.0f);
    host::Scene scene;
    scene.bounds = extent->bounds;
    if (options.draw.ground)
        scene.ground = extent->bounds.min.y;
    scene.camera = host::frameCamera(extent->framed(options.draw.split), radians(options.draw.yaw),
                                     radians(options.draw.pitch), aspect, kAnimateMargin);
    if (options.turn != 0.0) {
        // Turned, it needs the room of its sphere, about its middle.
        scene.camera.target = extent->bounds.center();
        scene.camera.distance =
            extent->bounds.radius() / std::sin(0.5f * scene.camera.fieldOfView) / std::min(1.0f, aspect);
    }
    scene.view = view;
    scene.cageFaces = options.draw.scheme == "cage";
    scene.cageEdges = scene.cageFaces || options.draw.cageOverlay;
    if (options.draw.split)
        scene.split = 0.0f;
    fitToPixels(scene, size);
    return scene;
}

} // namespace

std::string frameFile(const std::string& pattern, uint32_t frame) {
    const size_t last = pattern.find_last_of('#');
    if (last == std::string::npos)
        return {};
    const size_t before = pattern.find_last_not_of('#', last);
    const size_t first = before == std::string::npos ? 0 : before + 1;
    std::string number = std::to_string(frame);
    number.insert(0, last + 1 - first > number.size() ? last + 1 - first - number.size() : 0, '0');
    return pattern.substr(0, first) + number + pattern.substr(last + 1);
}

std::string animateOutputFault(const std::string& output) {
    if (output.ends_with(".webp"))
        return writesWebp() ? "" : output + ": this supple was built without libwebp";
    if (!output.ends_with(".png"))
        return output + " is neither .webp nor .png";
    return frameFile(output, 0).empty() ? output + " is one picture: for one a frame, put #### where their numbers go"
                                        : "";
}

Status animate(Session& session, const AnimateOptions& options) {
    const Result<VkExtent2D> size = parseSize(options.size);
    const Result<uint32_t> view = parseView(options.draw.view);
    if (!size || !view)
        return !size ? size.error() : view.error();
    Result<std::unique_ptr<Stage>> opened = Stage::open(session, options.file, *size, options.draw);
    if (!opened)
        return opened.error();
    Stage& stage = **opened;
    const Result<Course> course = courseOf(stage, options);
    if (!course)
        return course.error();
    Result<host::Scene> scene = sceneOf(stage, options, *course, *size, *view);
    if (!scene)
        return scene.error();
    Result<FrameOutput> output = FrameOutput::open(options, *size);
    if (!output)
        return output.error();
    const auto frames = static_cast<uint32_t>(std::max(1l, std::lround(course->seconds * options.fps)));
    const float yaw = scene->camera.yaw;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        showProgress("drawing frames", frame + 1, frames);
        if (const Status status = stage.pose(course->frame(frame, options.fps)); !status)
            return status.error();
        scene->camera.yaw = yaw + radians(options.turn) * static_cast<float>(frame) / static_cast<float>(frames);
        scene->lightYaw = scene->camera.yaw;
        const Result<host::Picture> picture = stage.draw(*scene, options.draw.alpha);
        if (!picture)
            return picture.error();
        if (const Status status = output->add(*picture); !status)
            return status.error();
    }
    return output->finish();
}

int runAnimate(const AnimateOptions& options) {
    if (const std::string fault = animateOutputFault(options.output); !fault.empty())
        return fail(kExitUsage, "--output: " + fault);
    const OutputPath output[] = {{"--output", options.output}};
    if (const Status writable = canWrite(output); !writable)
        return fail(writable.error());
    const int code =
        withSession(deviceFlags(options.draw), [&](Session& session) { return animate(session, options); });
    if (code == kExitOk && options.output.ends_with(".webp"))
        tellWritten(options.output);
    return code;
}

} // namespace supple::tools
