/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A plate with a hole, by the installed C interface.
 */
#include <stdio.h>
#include <trisect-c/trisect.h>

int main(void) {
    const double low[3] = {0, 0, 0};
    const double high[3] = {4, 3, 1};
    trisect_solid* plate = NULL;
    trisect_solid* drill = NULL;
    trisect_solid* part = NULL;
    double volume = 0;
    trisect_status status = trisect_solid_box(low, high, &plate);
    if (status == TRISECT_OK) status = trisect_solid_cylinder(0.5, 2, 64, &drill);
    if (status == TRISECT_OK) {
        const trisect_solid* operands[2];
        operands[0] = plate;
        operands[1] = drill;
        status = trisect_boolean(TRISECT_DIFFERENCE, operands, 2, &part);
    }
    if (status == TRISECT_OK) status = trisect_volume(part, &volume);
    if (status != TRISECT_OK) fprintf(stderr, "%s\n", trisect_error_message());
    trisect_solid_free(part);
    trisect_solid_free(drill);
    trisect_solid_free(plate);
    return status == TRISECT_OK && volume > 11 && volume < 12 ? 0 : 1;
}
