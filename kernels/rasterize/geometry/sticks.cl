// Computes the tip B of each vertex (docs/shells.md, section 3) from the sticks of a mass-spring topology. A work-item
// computes LANES vertices.
#include "rasterize/geometry/transform.clh"

// offset: the vectors q of the sticks (top minus base). The sticks are stored in slices of 16: first q_x of
// the 16 sticks, then q_y, then q_z.
// stick: for each vertex, the index in `offset` of the q_x of the vertex's stick.
// level: 0 selects the displacement s - n of Eq. 4 of Banisch and Wuethrich 2006, where s is the direction of
// the stick and n is the surface normal. 1 removes the component along n from this displacement
// (level_tip()).
__kernel void stick_tips(RasterParams s, int level, TABLE(int) stick, TABLE(float) offset, TABLE(float) vertex,
                         __global float *tip) {
  int block = (int)get_global_id(0);
  if (block * LANES >= s.vertices) return;
  whole i = load_whole(stick, block);
  real3 a = column3(vertex, ROOT_X, s.vertices, block);
  real3 q = vec3(gather(offset, i), gather(offset + 16, i), gather(offset + 32, i));
  // If a mass has diverged, its rest position is used instead, so that the triangles at its vertex cover few
  // tiles. The host detects diverged masses after the frame.
  truth sound = dot3(q, q) < REAL(1e30f);
  real3 b = stick_tip(choose3(sound, q, a), a);
  if (level) b = level_tip(b, a);
  store_real(b.x, tip, block);
  store_real(b.y, tip + s.vertices, block);
  store_real(b.z, tip + 2 * (size_t)s.vertices, block);
}
