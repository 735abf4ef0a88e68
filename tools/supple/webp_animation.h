// Animated pictures: WebP, by libwebp.
#pragma once

#include "base/result.h"
#include "host/picture.h"

#include <memory>
#include <string>

namespace supple::tools {

/// Whether this supple was built with libwebp.
[[nodiscard]] bool writesWebp();

/// Plays for ever. All pictures have one size.
class WebpAnimation {
public:
    /// quality: 0 to 100; 100 keeps every bit.
    [[nodiscard]] static Result<std::unique_ptr<WebpAnimation>> create(uint32_t width, uint32_t height, float quality);
    ~WebpAnimation();
    /// Shown from `milliseconds` after the start on.
    [[nodiscard]] Status add(const host::Picture& picture, int milliseconds);
    /// The last picture is shown until `milliseconds` after the start.
    [[nodiscard]] Status write(int milliseconds, const std::string& path);

private:
    struct State;
    explicit WebpAnimation(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace supple::tools
