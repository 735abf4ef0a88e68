// How far the floor shows shadows, in radii of the scene.
const float kFarthestShadow = 2.7;
// Beyond, nothing hides the sky.
const float kFarthestSkyShadow = 1.5;
