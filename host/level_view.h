// A Supple view for one group: a camera that chooses its levels of detail.
#pragma once

#include "host/camera.h"
#include "host/context.h"

#include <memory>
#include <optional>

namespace supple::host {

class LevelView {
public:
    /// tangents: groups of the view write them. The context must outlive the view.
    [[nodiscard]] static Result<std::unique_ptr<LevelView>> create(Context& context, SuppleVertexFormat format,
                                                                   bool tangents);
    ~LevelView();
    LevelView(const LevelView&) = delete;
    LevelView& operator=(const LevelView&) = delete;

    [[nodiscard]] SuppleView handle() const { return view_; }
    /// See FigureGroup::setLevelCamera().
    [[nodiscard]] Status setCamera(const Camera& camera, uint32_t height, float chordError);
    /// Those of the newest completed frame.
    [[nodiscard]] std::optional<SuppleViewStatistics> statistics() const;

private:
    explicit LevelView(Context& context) : context_(context) {}

    Context& context_;
    SuppleView view_{};
};

} // namespace supple::host
