// The game and its pictures.
#pragma once

#include "drawing.h"
#include "game.h"

#include "host/picture.h"

namespace play {

class Show {
public:
    Show(Device& device, const HeroOptions& options);

    /// Nothing may be in flight.
    void resize(VkExtent2D extent);
    /// One frame of the game, and Supple's passes.
    void update(uint64_t frame, uint64_t completed, const Input& input, float seconds);
    void draw(uint32_t slot, const Camera& camera);
    /// Behind draw(): the picture is read then, or goes to a window.
    void addReading();
    void addPresenting(const Swapchain& swapchain);
    void execute(VkCommandBuffer commands, uint32_t slot) { graph_.execute(commands, slot); }
    /// After the last frame: another one brings its hashes into a recording.
    void finish(uint64_t frame);

    [[nodiscard]] Picture readPicture() const;
    /// The vertices of all that is shown of the character in the frame that was executed last; waits for it.
    [[nodiscard]] std::vector<glm::vec3> readSurface() const;
    [[nodiscard]] const Game& game() const { return game_; }
    [[nodiscard]] float aspect() const;

private:
    Device& device_;
    Graph graph_;
    Resource buffers_, shown_;
    Hero hero_;
    Game game_;
    Drawing drawing_;
};

} // namespace play
