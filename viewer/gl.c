#include "gl.h"

#define LOAD(type, function)                                                                       \
    out->function = (PFNGL##type##PROC)s->load("gl" #function);                                    \
    NEED(out->function, STATUS_DEVICE, "OpenGL has no function gl" #function);

status gl_load(gl *out, const surface *s)
{
    status rc = STATUS_OK;

    GL_FUNCTIONS(LOAD)
out:
    return rc;
}
