"""Loops that carry heat with the flows of a film, from node to node in the order of the flow.

The flows F through the faces towards i + 1 and j + 1, m³/s, are zero for the last i or j unless these are periodic.
The heat per volume e of the liquid that leaves a node towards its neighbours along i, and along j, is

    e_x = e + a (e - e_up),    e_y = e + b (e - e_up),

with the neighbour upstream in the same direction: linear upwind differences, limited by the slope towards the next node
downstream.

All arrays have the shape (nx, ny): ``along`` and ``across`` are F, ``slope_x`` and ``slope_y`` are a and b, ``face_x``
and ``face_y`` are e_x and e_y, J/m³, and ``heat`` is e, J/m³; ``spacing_x``, shape (nx,), and ``spacing_y``, shape
(ny,), are the distances of the nodes from the next ones, m. Functions write into their last arrays.
"""

from roughfilm.contact.foundation.compiled import compiled, inlined

STEEPEST = 1.5
"""Slope towards the next node downstream over the slope at a node, up to which the latter is taken in full.

1 is the minmod limiter, 2 the largest value without overshoot. Above 1 smooth fields are not limited, so that their
slopes are not iterated; with 2 the iteration of limited ones converges slowly, if at all.
"""


@compiled
def arrange(along, across, waiting, stack, done, order, late):  # type: ignore[no-untyped-def]
    """Write the nodes into ``order``, each behind those from which it receives liquid, where flows are not closed.

    Where liquid circulates, the next node by number follows, and the nodes behind it from which it receives liquid
    become ``late``. ``waiting``, ``stack`` and ``done`` are of the size of ``order``, the last two with zeros.
    """
    nx, ny = along.shape
    top = 0
    for i in range(nx):
        for j in range(ny):
            count = (along[i - 1, j] > 0.0) + (along[i, j] < 0.0) + (across[i, j - 1] > 0.0) + (across[i, j] < 0.0)
            waiting[i * ny + j] = count
            if count == 0:
                stack[top] = i * ny + j
                top += 1
    following = 0
    for place in range(order.size):
        forced = top == 0
        if forced:
            while done[following]:
                following += 1
            node = following
        else:
            top -= 1
            node = stack[top]
        done[node] = 1
        order[place] = node
        i, j = node // ny, node % ny
        for side in range(4):
            k, m = i, j
            if side == 0:
                k, flow = (i + 1 if i + 1 < nx else 0), along[i, j]
            elif side == 1:
                k, flow = (i if i > 0 else nx) - 1, -along[i - 1, j]
            elif side == 2:
                m, flow = (j + 1 if j + 1 < ny else 0), across[i, j]
            else:
                m, flow = (j if j > 0 else ny) - 1, -across[i, j - 1]
            other = k * ny + m
            if flow > 0.0:
                waiting[other] -= 1
                if waiting[other] == 0 and not done[other]:
                    stack[top] = other
                    top += 1
            elif flow < 0.0 and forced and not done[other]:
                late[other] = 1


@inlined
def extrapolation(upstream, here, downstream, to_upstream, to_downstream, extrapolated):  # type: ignore[no-untyped-def]
    """The coefficient a of the heat at the downstream face; without extrapolation the upstream value is at the face."""
    distance = to_upstream if extrapolated else 0.5 * to_upstream
    rise, ahead = (here - upstream) / distance, (downstream - here) / to_downstream
    if rise * ahead <= 0.0:
        return 0.0
    return 0.5 * to_downstream / distance * min(1.0, STEEPEST * ahead / rise)


@inlined
def straight(fed_low, enters, leaves, fed_high, low, here, high, to_low, to_high):  # type: ignore[no-untyped-def]
    """The coefficient of a node between two others, from the flows through the four faces around, all in one sense."""
    if enters > 0.0 and leaves > 0.0:
        return extrapolation(low, here, high, to_low, to_high, fed_low > 0.0)
    if enters < 0.0 and leaves < 0.0:
        return extrapolation(high, here, low, to_high, to_low, fed_high < 0.0)
    return 0.0


@compiled
def limit(along, across, spacing_x, spacing_y, heat, lowered, slope_x, slope_y):  # type: ignore[no-untyped-def]
    """Write the coefficients a and b, 0 where no liquid flows straight through a node along i, or along j.

    If ``lowered``, they only decrease.
    """
    nx, ny = along.shape
    for i in range(nx):
        behind, ahead = (i if i > 0 else nx) - 1, (i + 1 if i + 1 < nx else 0)
        before, after = spacing_x[behind], spacing_x[i]
        for j in range(ny):
            low, high = (j if j > 0 else ny) - 1, (j + 1 if j + 1 < ny else 0)
            here = heat[i, j]
            first, enters, leaves, last = along[behind - 1, j], along[behind, j], along[i, j], along[ahead, j]
            slope = straight(first, enters, leaves, last, heat[behind, j], here, heat[ahead, j], before, after)
            slope_x[i, j] = min(slope, slope_x[i, j]) if lowered else slope
            first, enters, leaves, last = across[i, low - 1], across[i, low], across[i, j], across[i, high]
            to_low, to_high = spacing_y[low], spacing_y[j]
            slope = straight(first, enters, leaves, last, heat[i, low], here, heat[i, high], to_low, to_high)
            slope_y[i, j] = min(slope, slope_y[i, j]) if lowered else slope


@compiled
def straighten(along, across, slope_x, slope_y):  # type: ignore[no-untyped-def]
    """Set the coefficients a and b to 0 where no liquid flows straight through a node along i, or along j."""
    nx, ny = along.shape
    for i in range(nx):
        behind = (i if i > 0 else nx) - 1
        for j in range(ny):
            low = (j if j > 0 else ny) - 1
            if not along[behind, j] * along[i, j] > 0.0:
                slope_x[i, j] = 0.0
            if not across[i, low] * across[i, j] > 0.0:
                slope_y[i, j] = 0.0


@compiled
def sweep(order, along, across, slope_x, slope_y, centre, source, heat, face_x, face_y):  # type: ignore[no-untyped-def]
    """Solve Σ F e (outflow minus inflow) + c e = s for the heat of each node in turn, from the latest values of others.

    ``centre`` and ``source`` are c, m³/s, and s, W. Nodes that nothing reaches and nothing leaves keep their heat.
    """
    nx, ny = along.shape
    for place in range(order.size):
        node = order[place]
        i, j = node // ny, node % ny
        behind, ahead = (i if i > 0 else nx) - 1, (i + 1 if i + 1 < nx else 0)
        low, high = (j if j > 0 else ny) - 1, (j + 1 if j + 1 < ny else 0)
        west, east, south, north = along[behind, j], along[i, j], across[i, low], across[i, j]
        a, b = slope_x[i, j], slope_y[i, j]
        leaves, enters = centre[i, j], source[i, j]
        up_x = up_y = 0.0
        if west > 0.0:
            enters += west * face_x[behind, j]
            up_x = heat[behind, j]
        else:
            leaves -= west * (1.0 + a)
        if east < 0.0:
            enters -= east * face_x[ahead, j]
            up_x = heat[ahead, j]
        else:
            leaves += east * (1.0 + a)
        if south > 0.0:
            enters += south * face_y[i, low]
            up_y = heat[i, low]
        else:
            leaves -= south * (1.0 + b)
        if north < 0.0:
            enters -= north * face_y[i, high]
            up_y = heat[i, high]
        else:
            leaves += north * (1.0 + b)
        if a != 0.0:
            enters += max(east, -west) * a * up_x
        if b != 0.0:
            enters += max(north, -south) * b * up_y
        here = enters / leaves if leaves > 0.0 else heat[i, j]
        heat[i, j] = here
        face_x[i, j] = here + a * (here - up_x)
        face_y[i, j] = here + b * (here - up_y)


@compiled
def extrapolate(along, across, slope_x, slope_y, heat, face_x, face_y):  # type: ignore[no-untyped-def]
    """Write e_x and e_y of the nodes."""
    nx, ny = along.shape
    for i in range(nx):
        behind, ahead = (i if i > 0 else nx) - 1, (i + 1 if i + 1 < nx else 0)
        for j in range(ny):
            low, high = (j if j > 0 else ny) - 1, (j + 1 if j + 1 < ny else 0)
            here = heat[i, j]
            up_x = heat[behind if along[i, j] > 0.0 else ahead, j]
            up_y = heat[i, low if across[i, j] > 0.0 else high]
            face_x[i, j] = here + slope_x[i, j] * (here - up_x)
            face_y[i, j] = here + slope_y[i, j] * (here - up_y)


@compiled
def carry(along, across, face_x, face_y, balance):  # type: ignore[no-untyped-def]
    """Add to the balance of each node the heat that its flows carry to its neighbours, less what they bring, W."""
    nx, ny = along.shape
    for i in range(nx):
        k = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            m = j + 1 if j + 1 < ny else 0
            heat = along[i, j] * (face_x[i, j] if along[i, j] > 0.0 else face_x[k, j])
            balance[i, j] += heat
            balance[k, j] -= heat
            heat = across[i, j] * (face_y[i, j] if across[i, j] > 0.0 else face_y[i, m])
            balance[i, j] += heat
            balance[i, m] -= heat
