// How far the floor shows shadows, in radii of the scene.
const float kFarthestShadow = 3.2;
