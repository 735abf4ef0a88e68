#include "tools/supple/webp_animation.h"

#if SUPPLE_HAS_WEBP

#include "host/whole_file.h"

#include <webp/encode.h>
#include <webp/mux.h>

namespace supple::tools {

struct WebpAnimation::State {
    WebPAnimEncoder* encoder = nullptr;
    WebPConfig config{};

    [[nodiscard]] Error failure(const std::string& what) const {
        return Error{ErrorCode::io, what + ": " + WebPAnimEncoderGetError(encoder)};
    }
};

bool writesWebp() {
    return true;
}

WebpAnimation::WebpAnimation(std::unique_ptr<State> state) : state_(std::move(state)) {}

WebpAnimation::~WebpAnimation() {
    WebPAnimEncoderDelete(state_->encoder);
}

Result<std::unique_ptr<WebpAnimation>> WebpAnimation::create(uint32_t width, uint32_t height, float quality) {
    auto state = std::make_unique<State>();
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&state->config) == 0)
        return Error{ErrorCode::unsupported, "this libwebp is not the one supple was built for"};
    state->config.quality = quality;
    state->config.lossless = quality >= 100.0f ? 1 : 0;
    state->encoder = WebPAnimEncoderNew(static_cast<int>(width), static_cast<int>(height), &options);
    if (state->encoder == nullptr)
        return Error{ErrorCode::limit, "an animated WebP of " + std::to_string(width) + "x" + std::to_string(height) +
                                           " pixels: it takes 16383 a side"};
    return std::unique_ptr<WebpAnimation>(new WebpAnimation(std::move(state)));
}

Status WebpAnimation::add(const host::Picture& picture, int milliseconds) {
    WebPPicture frame;
    if (WebPPictureInit(&frame) == 0)
        return Error{ErrorCode::unsupported, "this libwebp is not the one supple was built for"};
    frame.use_argb = 1;
    frame.width = static_cast<int>(picture.width);
    frame.height = static_cast<int>(picture.height);
    const bool read = WebPPictureImportRGBA(&frame, picture.rgba.data(), frame.width * 4) != 0;
    const bool added = read && WebPAnimEncoderAdd(state_->encoder, &frame, milliseconds, &state_->config) != 0;
    WebPPictureFree(&frame);
    return added ? success() : Status(state_->failure("a picture of the animation"));
}

Status WebpAnimation::write(int milliseconds, const std::string& path) {
    WebPData data;
    WebPDataInit(&data);
    if (WebPAnimEncoderAdd(state_->encoder, nullptr, milliseconds, nullptr) == 0 ||
        WebPAnimEncoderAssemble(state_->encoder, &data) == 0)
        return state_->failure(path);
    Status status = host::writeWhole(path, {reinterpret_cast<const std::byte*>(data.bytes), data.size});
    WebPDataClear(&data);
    return status;
}

} // namespace supple::tools

#else

namespace supple::tools {

struct WebpAnimation::State {};

bool writesWebp() {
    return false;
}

WebpAnimation::WebpAnimation(std::unique_ptr<State> state) : state_(std::move(state)) {}
WebpAnimation::~WebpAnimation() = default;

Result<std::unique_ptr<WebpAnimation>> WebpAnimation::create(uint32_t, uint32_t, float) {
    return Error{ErrorCode::unsupported, "this supple was built without libwebp"};
}

Status WebpAnimation::add(const host::Picture&, int) {
    return success();
}

Status WebpAnimation::write(int, const std::string&) {
    return success();
}

} // namespace supple::tools

#endif
