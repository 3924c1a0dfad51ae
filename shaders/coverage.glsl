// How much of a pixel lies on the inner side of a straight edge, exactly: the square of the pixel cut
// by the edge. `inside_px` is the distance of its centre from the edge, positive inside; `normal`, of
// length 1, is perpendicular to the edge.
float covered(float inside_px, vec2 normal) {
  vec2 slope = abs(normal);
  float steep = max(max(slope.x, slope.y), 0.7);
  float gentle = max(min(slope.x, slope.y), 0.02);  // a degree: less would be lost in rounding
  inside_px = clamp(inside_px, -0.75, 0.75);
  // As the edge moves across the square, the cut's length grows from zero, stays constant, and
  // shrinks again.
  vec4 past = max(vec4(0.5 * (steep + gentle), 0.5 * (steep - gentle), -0.5 * (steep - gentle),
                       -0.5 * (steep + gentle)) + inside_px, 0.0);
  past *= past;
  return clamp((past.x - past.y - past.z + past.w) / (2.0 * steep * gentle), 0.0, 1.0);
}

// The greatest distance of an edge that still cuts the pixel from the pixel's centre.
const float kReach_px = 0.71;
