// The sharpness of spokes and edges.
const float kEndlessSharpness = 1e9;

// What is left after `steps` steps. Endless sharpness stays.
float softened(float sharpness, uint steps) {
    precise float left = sharpness - float(steps);
    return sharpness >= kEndlessSharpness ? sharpness : left > 0.0 ? left : 0.0;
}
