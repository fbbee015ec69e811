// Computes the strands of a frame: interpolates them between the key strands, projects them, and lists those that are
// drawn, with their sort keys. A work-item computes one run of consecutive strands. The list of run r begins at
// pair[r * capacity] and has live[r] entries (key, strand), in the order of the strands. For each strand that is drawn, the
// kernel also writes a row of ROW_FLOATS floats and the blocks of pixels that the strand may touch.
#define STRAND_MAP p->is_map
#include "common/powers.clh"
#include "common/slices.clh"
#include "strands/draw/curve.clh"
#include "strands/draw/fills.clh"

// The constants of a strand are read once, so the processor has to fetch them from memory.
#define UNITS_AHEAD 6
#if LANES > 1 && BUILTIN(__builtin_prefetch)
INLINE void read_unit_soon(TABLE(scalar) strands, int u) {
  for (int column = 0; column < (STRAND_STYLES ? DRAWN_COLUMNS : DRAWN_RESPONSE); ++column)
    __builtin_prefetch((const void *)(size_t)(strands + LANES * column_of(u, DRAWN_COLUMNS, column)));
}
#else
INLINE void read_unit_soon(TABLE(scalar) strands, int u) {}
#endif

INLINE Key load_key(TABLE(float) keys, whole index) {
  real4 a = gather_rows(keys, 4 * index), b = gather_rows(keys, 4 * index + 1), c = gather_rows(keys, 4 * index + 2);
  Key k;
  k.root = vec3(a.x, a.y, a.z);
  k.normal = vec3(a.w, b.x, b.y);
  k.u = vec3(b.z, b.w, c.x);
  k.w = vec3(c.y, c.z, c.w);
#if STRAND_STYLES || STRAND_SHAPES
  real4 d = gather_rows(keys, 4 * index + 3);
  k.rest = vec3(d.x, d.y, d.z);
#endif
  return k;
}

INLINE real drawn_value(TABLE(scalar) strands, int u, int column) {
  return load_real(strands, column_of(u, DRAWN_COLUMNS, column));
}
INLINE whole drawn_bits(TABLE(scalar) strands, int u, int column) {
  return bits_as_whole(drawn_value(strands, u, column));
}

#if STRAND_SHAPES
// Returns a control point of a curve of a strand of a file. point: 0, 1 or 2.
INLINE real3 control_point(TABLE(scalar) shapes, int u, Curve strand, Key k, int point, real s) {
  return shaped_point(strand, k, s, load3(shapes, u, SHAPE_COLUMNS, SHAPE_OFFSET + 3 * point));
}
#endif

#if STRAND_STYLES
INLINE Turn drawn_turn(TABLE(scalar) strands, int u, int column) {
  whole bits = drawn_bits(strands, u, column);
  Turn t;
  t.cosine = to_real((bits << 16) >> 16) * REAL(1.0f / 32767.0f);
  t.sine = to_real(bits >> 16) * REAL(1.0f / 32767.0f);
  return t;
}
#endif

INLINE void store_curve(Curve c, __global scalar *curves, int u) {
  store3(c.root, curves, u, CURVE_COLUMNS, CURVE_ROOT);
  store3(c.joint, curves, u, CURVE_COLUMNS, CURVE_JOINT);
  store3(c.tip, curves, u, CURVE_COLUMNS, CURVE_TIP);
  store3(c.normal, curves, u, CURVE_COLUMNS, CURVE_NORMAL);
}

// Returns the number of the block, in one direction, that contains a position in pixels, limited to 0 .. blocks - 1.
INLINE whole block_at(const DrawParams *p, real position, int blocks) {
  real per_block = REAL(1.0f / (float)p->block_side);
  return to_whole(lesser(greater(position * per_block, REAL(0.0f)), REAL((float)(blocks - 1))));
}

// A range of blocks in the picture. The low half of a word is the column, the high half the row.
typedef struct { whole first, last; } Blocks;

// Returns the blocks that a strand may touch. The control points enclose the curve if none is nearer than the near plane.
// Otherwise the strand may touch all blocks. A fragment is not further from the curve than the square root of 2 times
// (half + 1/2), where half is the half width in pixels.
INLINE Blocks blocks_of(const DrawParams *p, real3 a, real3 b, real3 c, real radius) {
  real least = lesser(a.z, lesser(b.z, c.z));
  truth in_front = least >= REAL(p->near_depth);
  real wa = per_depth_at(p, in_front ? a.z : REAL(1.0f)), wb = per_depth_at(p, in_front ? b.z : REAL(1.0f));
  real wc = per_depth_at(p, in_front ? c.z : REAL(1.0f));
  real pad = 1.5f * fma(radius, greater(wa, greater(wb, wc)), REAL(0.5f));
  real ax = a.x * wa, bx = b.x * wb, cx = c.x * wc, ay = a.y * wa, by = b.y * wb, cy = c.y * wc;
  real mid_x = REAL(0.5f * (float)p->width), mid_y = REAL(0.5f * (float)p->height);
  int across = (p->width + p->block_side - 1) / p->block_side, down = (p->height + p->block_side - 1) / p->block_side;
  whole left = block_at(p, lesser(ax, lesser(bx, cx)) - pad + mid_x, across);
  whole right = block_at(p, greater(ax, greater(bx, cx)) + pad + mid_x, across);
  whole top = block_at(p, lesser(ay, lesser(by, cy)) - pad + mid_y, down);
  whole bottom = block_at(p, greater(ay, greater(by, cy)) + pad + mid_y, down);
  Blocks out;
  out.first = in_front ? left | (top << 16) : WHOLE(0);
  out.last = in_front ? right | (bottom << 16) : WHOLE((across - 1) | (down - 1) << 16);
  return out;
}

// Returns true if the strand is not entirely nearer than the near plane, and not beyond a side of the picture. depth: view
// depths of root, joint and tip. margin: an upper bound of W times half of the strand's width in pixels.
INLINE truth in_picture(const DrawParams *p, real3 root, real3 joint, real3 tip, real3 depth, real margin) {
  real near = REAL(p->near_depth);
  truth some_in_front = (depth.x >= near) || (depth.y >= near) || (depth.z >= near);
  truth in_front = (depth.x >= near) && (depth.y >= near) && (depth.z >= near);
  truth outside = beyond_side(root.x, joint.x, tip.x, depth, 0.5f * (float)p->width + 1.0f, margin) ||
                  beyond_side(root.y, joint.y, tip.y, depth, 0.5f * (float)p->height + 1.0f, margin);
  return some_in_front && !(in_front && outside);
}

#if STRAND_LIGHTS
// Returns the light that does not change along the strand. layer: LAYER_RECORD times the number of the strand's fur layer.
INLINE real3 steady_light(const DrawParams *p, TABLE(int) layers, whole layer, Curve curve, real3 colour) {
  real3 from_eye = sub3(curve.joint, uniform3(p->eye[0], p->eye[1], p->eye[2]));
  from_eye = unit3(from_eye, dot3(from_eye, from_eye));
  real exponent = REAL(p->rim_exponent);
#if STRAND_LAYERS
  exponent = exponent * bits_as_real(gather_whole(layers, layer + LAYER_RIM_EXPONENT));
#endif
  real edge = power(greater(1.0f - fabs(dot3(curve.normal, from_eye)), REAL(0.0f)), exponent);
  real3 rim = scale3(edge, uniform3(p->rim[0], p->rim[1], p->rim[2]));
#if STRAND_LAYERS
#define OWN_RIM(i) bits_as_real(gather_whole(layers, layer + (LAYER_RIM + i)))
  rim = vec3(rim.x * OWN_RIM(0), rim.y * OWN_RIM(1), rim.z * OWN_RIM(2));
#undef OWN_RIM
#endif
  return vec3(fma(colour.x, p->ambient + fill_light(p->fill, curve.normal), rim.x),
              fma(colour.y, p->ambient + fill_light(p->fill + 9, curve.normal), rim.y),
              fma(colour.z, p->ambient + fill_light(p->fill + 18, curve.normal), rim.z));
}

// Returns the number of the strand's film frame. layer: LAYER_RECORD times the number of the strand's fur layer.
INLINE whole film_frame(TABLE(int) layers, whole layer, whole strand) {
  wide hash = to_wide(strand * WHOLE((int)2654435761u)) & 0xffffffffL;
  return gather_whole(layers, layer + 1) + narrow(hash * to_wide(gather_whole(layers, layer + 2)) >> 32);
}
#endif

CALLED void keys_of_run(const DrawParams *restrict p, TABLE(scalar) strands, TABLE(scalar) shapes, TABLE(float) keys,
                        TABLE(int) layers, __global float *row, __global uint2 *blocks, __global uint2 *pair, __global int *live, __global scalar *curves, int run) {
  if (run >= p->runs) return;
  int first = run * p->units_per_run, last = min(first + p->units_per_run, p->units);
  __global uint2 *out = pair + (size_t)run * p->capacity;    // in a map, the lists of the runs have no gaps
  int listed = 0;
  for (int u = first; u < last; ++u) {
    Key a = load_key(keys, drawn_bits(strands, u, DRAWN_KEY));
    if (u + UNITS_AHEAD < last) read_unit_soon(strands, u + UNITS_AHEAD);
    if (u + 1 < last)
      for (int k = 0; k < (STRAND_SHAPES ? 1 : 3); ++k) read_soon(keys, KEY_RECORD * drawn_bits(strands, u + 1, DRAWN_KEY + k));
#if STRAND_SHAPES
    Key key = a;
#else
    Key b = load_key(keys, drawn_bits(strands, u, DRAWN_KEY + 1)), c = load_key(keys, drawn_bits(strands, u, DRAWN_KEY + 2));
    Key key = between_keys(a, b, c, drawn_value(strands, u, DRAWN_WEIGHT), drawn_value(strands, u, DRAWN_WEIGHT + 1));
#endif
#if STRAND_STYLES
    key = styled(key, drawn_value(strands, u, DRAWN_RESPONSE), drawn_turn(strands, u, DRAWN_TWIST), drawn_turn(strands, u, DRAWN_CURVATURE));
#endif
    key = above_skin(key, p->slope);
    Curve curve = curve_of(key, drawn_value(strands, u, DRAWN_LENGTH), p->first_segment);
#if STRAND_SHAPES
    real from = load_real(shapes, column_of(u, SHAPE_COLUMNS, SHAPE_FROM));
    real to = load_real(shapes, column_of(u, SHAPE_COLUMNS, SHAPE_TO));
    Curve strand = curve;
    curve.root = control_point(shapes, u, strand, key, 0, from);
    curve.joint = control_point(shapes, u, strand, key, 1, 0.5f * (from + to));
    curve.tip = control_point(shapes, u, strand, key, 2, to);
#endif
    if (p->keep_curves) store_curve(curve, curves, u);

    whole number = u * LANES + lane_numbers();
    real3 root = in_view(p, curve.root), joint = in_view(p, curve.joint), tip = in_view(p, curve.tip);
    real3 depth = vec3(root.z, joint.z, tip.z);
    real fade = lesser(to_real(WHOLE(p->strands) - number) * REAL(p->per_fade), REAL(1.0f));
    real radius = drawn_value(strands, u, DRAWN_WIDTH) * (p->widen * fade) * REAL(p->half_per_width);
#if STRAND_SHAPES
    real width_end = load_real(shapes, column_of(u, SHAPE_COLUMNS, SHAPE_WIDTH_END));
    real widest = radius * greater(width_end, REAL(1.0f));
#else
    real widest = radius;
#endif
    truth drawn = number < WHOLE(p->strands);
    truth back = faces_away(curve.normal, sub3(uniform3(p->eye[0], p->eye[1], p->eye[2]), key.root));
    if (!p->is_map) drawn = drawn && in_picture(p, root, joint, tip, depth, 1.5f * widest);    // all strands cast a shadow
    if (!p->is_map && p->back_facing == BACK_REMOVED) drawn = drawn && !back;
    if (!some(drawn)) continue;

    whole colour = drawn_bits(strands, u, DRAWN_COLOUR);
    whole layer = LAYER_RECORD * ((colour >> 24) & 255);
    whole sort_key = (gather_whole(layers, layer) << 24) | depth_step(p, depth.y);
    if (p->back_facing == BACK_LAST) sort_key = back ? WHOLE((int)LAST_KEY) : sort_key;
#if STRAND_LIGHTS
    real3 steady = steady_light(p, layers, layer, curve, vec3(colour_byte(colour, 0), colour_byte(colour, 1), colour_byte(colour, 2)));
    real scale = 1.0f / (p->skin_shadow_height * drawn_value(strands, u, DRAWN_LENGTH));
    real joint_height = dot3(curve.normal, sub3(curve.joint, key.root)) * scale;
    real tip_height = dot3(curve.normal, sub3(curve.tip, key.root)) * scale;
    // The parts of a strand of a file share a frame of the film strip.
    whole framed = STRAND_SHAPES ? drawn_bits(strands, u, DRAWN_KEY) : number;
    colour = (colour & 0xffffff) | (film_frame(layers, layer, framed) << 24);
    real4 part[4] = {{root.x, root.y, root.z, joint.x}, {joint.y, joint.z, tip.x, tip.y},
                     {tip.z, radius, bits_as_real(colour), joint_height}, {tip_height, steady.x, steady.y, steady.z}};
    const int parts = 4;
#else
    real4 part[3] = {{root.x, root.y, root.z, joint.x}, {joint.y, joint.z, tip.x, tip.y}, {tip.z, radius, bits_as_real(colour), REAL(0.0f)}};
    const int parts = 3;
#endif
    __global float *rows = row + (size_t)u * (LANES * ROW_FLOATS);
    for (int i = 0; i < parts; ++i) store_rows_apart(part[i], rows + 4 * i, ROW_FLOATS);
#if STRAND_SHAPES
#if STRAND_LIGHTS
    real root_height = dot3(curve.normal, sub3(curve.root, key.root)) * scale;
#else
    real root_height = REAL(0.0f);
#endif
    real4 shape = {from, to, width_end, root_height};
    store_rows_apart(shape, rows + 16, ROW_FLOATS);
#endif
    Blocks touched = blocks_of(p, root, joint, tip, widest);
    int key_of[LANES], number_of[LANES], first_of[LANES], last_of[LANES];
    int count = squeeze(sort_key, drawn, key_of);
    squeeze(number, drawn, number_of);
    squeeze(touched.first, drawn, first_of);
    squeeze(touched.last, drawn, last_of);
    for (int i = 0; i < count; ++i) {
      out[listed + i] = (uint2)((uint)key_of[i], (uint)number_of[i]);
      blocks[number_of[i]] = (uint2)((uint)first_of[i], (uint)last_of[i]);
    }
    listed += count;
  }
  live[run] = listed;
}

// shapes: see params.h.
__kernel void strand_keys(DrawParams p, TABLE(scalar) strands, TABLE(scalar) shapes, TABLE(float) keys, TABLE(int) layers,
                          __global float *row, __global uint2 *blocks, __global uint2 *pair, __global int *live, __global scalar *curves) {
  keys_of_run(&p, strands, shapes, keys, layers, row, blocks, pair, live, curves, (int)get_global_id(0));
}
