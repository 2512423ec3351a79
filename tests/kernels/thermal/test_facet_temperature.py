import numpy as np
import pyopencl as cl
import records

NONE = 0xFFFFFFFF


def test_a_pixel_has_the_temperature_of_its_facet_and_no_history(opencl):
    hit = np.zeros(3, records.HIT)
    hit["facet"] = [1, NONE, 0]
    flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
    buffers = [cl.Buffer(opencl.context, flags, hostbuf=a)
               for a in (hit, np.array([290.0, 310.0], np.float32))]
    temperature_k, planes = np.zeros(3, np.float32), np.zeros((5, 3), np.float32)
    outputs = [cl.Buffer(opencl.context, cl.mem_flags.READ_WRITE | cl.mem_flags.COPY_HOST_PTR, hostbuf=a)
               for a in (temperature_k, planes)]

    opencl.build("facet_temperature")(opencl.queue, (64,), (64,), np.uint32(3), np.uint32(3), *buffers,
                                      *outputs)
    cl.enqueue_copy(opencl.queue, temperature_k, outputs[0])
    cl.enqueue_copy(opencl.queue, planes, outputs[1])

    assert list(temperature_k) == [310.0, 0.0, 290.0]
    assert (planes[:3] == 0).all() and (planes[3:] == -9999).all()
