/* Contacts in MuJoCo's visualization. */
#ifndef PONG_CONTACT_PICTURE_H
#define PONG_CONTACT_PICTURE_H

#include <mujoco/mujoco.h>
#include <pong.h>
#include <stddef.h>

/* Adds geoms to the scene by its options: with mjVIS_CONTACTPOINT a disc at every contact, green if it sticks
 * and red if it slips; with mjVIS_CONTACTFORCE an arrow of the force on the first Object of the contact.
 * Sizes are those of MuJoCo's own contacts (visual/scale, visual/map). */
void draw_contacts(mjvScene *scene, const mjModel *m, const mjvOption *options, const pong_contact *contacts, size_t count);

#endif
