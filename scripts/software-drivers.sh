# Read by the other scripts (`. scripts/software-drivers.sh`): picks Mesa's drivers that run on the CPU, so that results
# are the same on every machine.  PELLUCID_DRIVERS=system keeps the machine's own.
if [ "${PELLUCID_DRIVERS:-software}" = software ]; then
    for found in /usr/share/vulkan/icd.d/lvp_icd*.json; do
        [ -e "$found" ] || continue
        export VK_ICD_FILENAMES="$found" VK_DRIVER_FILES="$found"
    done
    export LIBGL_ALWAYS_SOFTWARE=1
    if [ -e /usr/share/glvnd/egl_vendor.d/50_mesa.json ]; then
        export __EGL_VENDOR_LIBRARY_FILENAMES=/usr/share/glvnd/egl_vendor.d/50_mesa.json
    fi
fi
