#pragma once

namespace orthonav::render {

/// Keeps the C library from handing freed memory back to the system after each frame; called for a
/// device that draws on the processor. llvmpipe allocates several MiB for the triangles of a frame
/// and frees them again. Where the C library returns them, they are mapped anew page by page, which
/// may take longer than drawing. The limits are those that glibc sets by itself once a block of 32
/// MiB has been freed; other C libraries are left as they are.
void keep_freed_memory();

}  // namespace orthonav::render
