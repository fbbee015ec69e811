// Colliders push the tops of the sticks after a time step (docs/colliders.md). A work-item computes a unit
// of LANES sticks. The host defines PRISMS for the topology prisms, which stores velocities in rows.
#include "common/contact.clh"
#include "springs/places.clh"

// contact, field: as common/contact.clh describes. time: number of the step in `contact`. tops: the tops in rows; with
// on_skin 1 relative to the origin, otherwise to the bases.
__kernel void contact_step(int units, int time, TABLE(scalar) sites, TABLE(scalar) contact, TABLE(scalar) field,
                           __global scalar *offset, __global scalar *speed
#if PRISMS
                           , __global scalar *tops, int on_skin
#endif
) {
  int u = (int)get_global_id(0);
  if (u >= units) return;
  real3 root = load3(sites, u, SITE_COLUMNS, SITE_ROOT), normal = load3(sites, u, SITE_COLUMNS, SITE_NORMAL);
  Pushed a;
  a.place = load3(offset, u, 3, 0);
#if PRISMS
  a.speed = xyz(load_rows(speed, u));
#else
  a.speed = load3(speed, u, 3, 0);
#endif
  a = pushed_out(colliders_at(contact, field, time), a, root, normal);
  store3(a.place, offset, u, 3, 0);
#if PRISMS
  store_rows(row_of(a.speed), speed, u);
  store_rows(row_of(on_skin ? add3(root, a.place) : a.place), tops, u);
#else
  store3(a.speed, speed, u, 3, 0);
#endif
}
