/* Device error: names of OpenCL error codes. */
#ifndef DEVICE_ERROR_H
#define DEVICE_ERROR_H

/* Name of an OpenCL error code, as CL_OUT_OF_RESOURCES; "OpenCL error -N" for unknown ones, valid
 * until the next call of this thread. */
const char *device_error(int code);

#endif
