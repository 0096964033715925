---@meta feather
-- Made from bindings/lua/feather and include/feather.h by tools/annotate. No program loads it.

---@class feather.WorldOptions
---@field workers? integer
---@field pool? feather.Pool
---@field store? feather.Store
---@field userData? any
---@field gravity? number[] m/s2.
---@field substeps? integer 1..64.
---@field simd? integer|string|string[] fe_simd.
---@field number? integer 1..4095, part of its handles; 0: the next of a counter.

---@class feather.BodyOptions
---@field position? number[]
---@field rotation? number[]
---@field userData? any
---@field locks? string[]
---@field type? integer|string|string[] fe_body_type.
---@field transform? number[] of the body's origin
---@field linearVelocity? number[] of the centre of mass, m/s
---@field angularVelocity? number[] rad/s, world axes
---@field linearDamping? number 1/s, >= 0: v /= 1 + h c in each substep of h seconds.
---@field angularDamping? number 1/s, >= 0.
---@field gravityScale? number Default 1
---@field sleepThreshold? number may sleep when its fastest point is slower, m/s, >= 0.
---@field linearLocks? string letters of "xyz": world axes along which it cannot move.
---@field angularLocks? string letters of "xyz": world axes about which it cannot rotate.
---@field awake? boolean 0: starts asleep, at rest.
---@field sleepAllowed? boolean Default 1
---@field enabled? boolean 0: neither moves, nor collides, nor is seen by queries.
---@field bullet? boolean 1: stopped by moving bodies too when it is fast.

---@class feather.ShapeOptions
---@field position? number[]
---@field rotation? number[]
---@field userData? any
---@field friction? number
---@field restitution? number
---@field density? number kg/m3, >= 0; a trigger weighs too.
---@field trigger? boolean 1: reports dynamic and kinematic bodies that touch it, pushes nothing.
---@field layer? integer exactly one bit.
---@field mask? integer the layers it collides with; 0: seen by queries only.
---@field group? integer 0: none.
---@field events? integer|string|string[] fe_shape_events; a pair has what either shape asks for.
---@field pairFilter? boolean 1: the world's pair filter judges its new pairs.
---@field oneWay? boolean 1: holds only what comes against `one_way_direction`; convex forms.
---@field oneWayDirection? number[] shape frame, any length but zero: up, for a floor to jump through.
---@field surfaceVelocity? number[] of a conveyor belt, m/s, shape frame; only its part along the contact acts

---@class feather.QueryFilter
---@field exclude? feather.Body|feather.Body[]
---@field mask? integer layers that count.
---@field flags? integer|string|string[] fe_query_flags.

---@class feather.Tuning
---@field contactHertz? number stiffness of contacts, 1/s, > 0; twice that against static bodies.
---@field contactDampingRatio? number >= 0; 1 is critical, higher pushes out more gently.
---@field contactPushSpeed? number overlap is pushed out no faster, m/s, >= 0.
---@field jointHertz? number stiffness of joints, 1/s, > 0.
---@field jointDampingRatio? number >= 0.
---@field restitutionThreshold? number slower impacts do not bounce, m/s, >= 0.
---@field hitEventThreshold? number slower impacts make no hit event, m/s, >= 0.
---@field sleepTime? number how long a body must be slow before it may sleep, s, >= 0.
---@field speculativeDistance? number contacts are made up to this gap, m, 0.001..0.1.
---@field maxLinearSpeed? number m/s, > 0.
---@field sleepEnabled? boolean 0: nobody falls asleep, and who sleeps wakes.
---@field continuousEnabled? boolean 0: fast bodies may pass through thin ones.
---@field warmStartEnabled? boolean 0: contacts begin each step without the impulses of the last one.

---@class feather.MassData
---@field mass? number kg, > 0
---@field centre? number[] of mass, m, body space
---@field inertia? number[] principal moments about the centre, kg m2, > 0, none above the sum of the other two
---@field inertiaRotation? number[] principal axes in body space

---@class feather.JointState
---@field angle? number the twist; of a hinge the angle, rad
---@field swingY? number rad
---@field swingZ? number rad
---@field angularVelocity? number[] of B against A, rad/s, axes of frame A
---@field translation? number[] of frame B's point in frame A, m
---@field linearVelocity? number[] its rate of change, m/s
---@field length? number between the two points, m
---@field speed? number its rate of change, m/s
---@field linearError? number distance of the points from where they are held, or beyond a limit, m
---@field angularError? number likewise, rad

---@class feather.Counters
---@field bodies? integer alive
---@field shapes? integer alive
---@field joints? integer alive
---@field awakeBodies? integer dynamic and kinematic ones
---@field pairs? integer pairs of shapes whose bounds meet
---@field contacts? integer of these, touching, triggers not counted
---@field recycled? integer contacts that kept their manifold in the last step
---@field islands? integer awake
---@field colours? integer of the largest island
---@field rows? integer of W contacts each, or of 4 where a colour has no more
---@field rowsWhole? integer of these, in islands that one worker solved whole
---@field lanes? integer contacts in all rows
---@field simd? integer|string|string[] fe_simd in use
---@field simdWidth? integer W, floats side by side
---@field workers? integer that a step is spread over
---@field bytes? integer allocated now, without its store
---@field allocations? integer since the world was created
---@field trees? integer awake sets of joints without a loop that the last step solved exactly
---@field contactsLeftOut? integer|string|string[] since the world was created: see fe_world_step

---@class feather.Profile
---@field step? number all of it
---@field pairs? number tree queries, new pairs
---@field collide? number narrow phase, recycling
---@field islands? number islands, colours, batches
---@field solve? number all substeps
---@field continuous? number bodies too fast for their size
---@field finalize? number poses, bounds, trees
---@field events? number touching begun and ended, impacts, broken joints
---@field sleep? number who falls asleep

---@class feather.HullInfo
---@field vertexCount? integer 4..255
---@field edgeCount? integer vertices - edges + faces = 2
---@field faceCount? integer 4..506
---@field volume? number m3
---@field area? number of the surface, m2
---@field centre? number[] of mass, m
---@field inertia? number[] principal moments about the centre at a density of 1 kg/m3, kg m2
---@field inertiaRotation? number[] from the principal axes to those of the points
---@field lower? number[] least and greatest corner of the bounds of the vertices, m
---@field upper? number[] least and greatest corner of the bounds of the vertices, m
---@field thickness? number the least distance between a face and the vertex farthest from it, m
---@field innerRadius? number of the largest ball about the centre that is inside, m
---@field tolerance? number what counted, m
---@field error? number how far the farthest point that was left out lies outside a face's plane, m, >= 0
---@field bytes? integer of memory

---@class feather.MeshInfo
---@field triangleCount? integer that are kept
---@field degenerateTriangles? integer dropped: no higher than 3e-8 of their largest coordinate
---@field duplicateTriangles? integer dropped: the same corners and winding as an earlier one
---@field vertexCount? integer places that differ
---@field openEdges? integer of one triangle
---@field crowdedEdges? integer of more than two
---@field flippedEdges? integer of two with opposite windings
---@field treeHeight? integer levels of nodes
---@field materialCount? integer 0: its triangles have their shape's material
---@field lower? number[] least and greatest corner of the bounds, m
---@field upper? number[] least and greatest corner of the bounds, m
---@field area? number m2
---@field volume? number m3 of a closed mesh, negative when it is wound inside out; else 0
---@field bytes? integer of memory

---@class feather.CompoundInfo
---@field partCount? integer how many parts it has
---@field lower? number[] least and greatest corner of the bounds of its parts, m, in the compound's space
---@field upper? number[] least and greatest corner of the bounds of its parts, m, in the compound's space
---@field bytes? integer of memory, without the assets of its parts

---@class feather.PlayerInfo
---@field library? integer|string|string[] fe_version of the library that recorded; 0: no header yet
---@field flags? integer|string|string[] fe_record_flags of the recording
---@field foreign? integer 1: the results of that library differ from this one's
---@field firstStep? integer where the first keyframe stands
---@field lastStep? integer where the last whole chunk begins, at least: what it holds shows as it is played
---@field step? integer where the player is: steps of the recording, from the world's step number at its start on
---@field calls? integer that were made since the player's creation, steps among them
---@field bytes? integer fed, of whole chunks
---@field keyframes? integer in these
---@field notes? integer likewise
---@field hasDiverged? integer 1: there is a divergence to be told

---@class feather.DistanceJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field pointA? number[]
---@field pointB? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of both ends of the range
---@field dampingRatio? number of both ends of the range
---@field breakForce? number
---@field breakTorque? number
---@field limitEnabled? boolean 1: lower <= distance <= upper.
---@field lower? number m, >= 0, at most upper.
---@field upper? number m, >= 0.001.
---@field springHertz? number 1/s, >= 0; 0: no spring.
---@field springDampingRatio? number >= 0.
---@field springMax? number cap of the spring, N, >= 0.
---@field target? number distance that the spring pulls to, m, >= 0.
---@field motorSpeed? number at which the motor lengthens it, m/s.
---@field motorMax? number cap, N, >= 0; with speed 0 a friction; 0: no motor.

---@class feather.BallJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field axis? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of the points
---@field dampingRatio? number of the points
---@field breakForce? number
---@field breakTorque? number
---@field coneEnabled? boolean 1: (swing_y / cone_y)^2 + (swing_z / cone_z)^2 <= 1.
---@field coneY? number half angles, rad, 0.01..pi.
---@field coneZ? number half angles, rad, 0.01..pi.
---@field limitEnabled? boolean 1: lower <= twist <= upper.
---@field lower? number rad, -pi..pi.
---@field upper? number rad, -pi..pi.
---@field limitHertz? number of cone and limits, 1/s, >= 0; 0: rigid.
---@field limitDampingRatio? number >= 0.
---@field springHertz? number of the spring that rotates B to `target`, 1/s, >= 0; 0: none.
---@field springDampingRatio? number >= 0.
---@field springMax? number its cap, N m, >= 0.
---@field target? number[] q to reach.
---@field motorVelocity? number[] of B against A, rad/s, frame A.
---@field motorMax? number cap, N m, >= 0; with velocity 0 a friction; 0: no motor.

---@class feather.HingeJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field axis? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of points and axes
---@field dampingRatio? number of points and axes
---@field breakForce? number
---@field breakTorque? number
---@field limitEnabled? boolean 1: lower <= angle <= upper.
---@field lower? number rad, -pi..pi.
---@field upper? number rad, -pi..pi.
---@field limitHertz? number 1/s, >= 0; 0: rigid.
---@field limitDampingRatio? number >= 0.
---@field springHertz? number of the spring that rotates it to `target`, 1/s, >= 0; 0: none.
---@field springDampingRatio? number >= 0.
---@field springMax? number its cap, N m, >= 0.
---@field target? number rad, -pi..pi.
---@field motorSpeed? number rad/s.
---@field motorMax? number cap, N m, >= 0; with speed 0 a friction; 0: no motor.

---@class feather.FixedJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of the points
---@field dampingRatio? number of the points
---@field breakForce? number
---@field breakTorque? number
---@field angularHertz? number of the rotation, 1/s, >= 0; 0: rigid.
---@field angularDampingRatio? number >= 0.

---@class feather.ConfigurableJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field axis? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of the locked axes
---@field dampingRatio? number of the locked axes
---@field breakForce? number
---@field breakTorque? number

---@class feather.RopeJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field pointA? number[]
---@field pointB? number[]
---@field maxLength? number
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of both ends of the range
---@field dampingRatio? number of both ends of the range
---@field breakForce? number
---@field breakTorque? number
---@field limitEnabled? boolean 1: lower <= distance <= upper.
---@field lower? number m, >= 0, at most upper.
---@field upper? number m, >= 0.001.
---@field springHertz? number 1/s, >= 0; 0: no spring.
---@field springDampingRatio? number >= 0.
---@field springMax? number cap of the spring, N, >= 0.
---@field target? number distance that the spring pulls to, m, >= 0.
---@field motorSpeed? number at which the motor lengthens it, m/s.
---@field motorMax? number cap, N, >= 0; with speed 0 a friction; 0: no motor.

---@class feather.SliderJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field axis? number[]
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field hertz? number of the locked axes
---@field dampingRatio? number of the locked axes
---@field breakForce? number
---@field breakTorque? number

---@class feather.WheelJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field point? number[]
---@field axis? number[]
---@field up? number[]
---@field hertz? number
---@field dampingRatio? number
---@field travel? number
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field breakForce? number
---@field breakTorque? number

---@class feather.MotorJointOptions
---@field bodyA? feather.Body|nil
---@field bodyB? feather.Body|nil
---@field userData? any
---@field hertz? number
---@field dampingRatio? number
---@field maxForce? number
---@field maxTorque? number
---@field enabled? boolean
---@field worldOrigin? number[]
---@field collideConnected? boolean
---@field breakForce? number
---@field breakTorque? number

---Everything that can touch each other.
---@class feather.World
local World = {}

---Force at the centre, N, then torque, N m, 6 floats a body, during the next step.
---@param bodies feather.Body[]
---@param numbers any
---@return any
function World:addForces(bodies, numbers) end

---A torque about the axis on B, N m, or a force along it, N, and the opposite on A, during the next step: a float a
---joint.
---@param joints feather.Joint[]
---@param forces any
---@return any
function World:addJointForces(joints, forces) end

---A second world like this one, of newWorld's table, in which workers, pool and simd count: both go on bit for bit,
---and share a store. It has the pair filter and the user data, each the same value.
---@param given? feather.WorldOptions
---@return feather.World
function World:clone(given) end

---The point of all surfaces that is closest to a point.
---@param x number
---@param y number
---@param z number
---@param distance number
---@param given? feather.QueryFilter
function World:closestPoint(x, y, z, distance, given) end

---Destroys the world and all in it.
function World:destroy() end

---All or none: with one stale handle, or one given twice, none is destroyed.
---@param bodies feather.Body[]
function World:destroyBodies(bodies) end

---LuaJIT alone: what the other draw methods give, in an array of the ffi.
---@param kind string
---@param given? table
---@param array? any
---@return any
---@return integer
function World:drawArray(kind, given, array) end

---16 numbers a shape: type, rgba, shape, body, asset, x, y, z, rotation x, y, z, w, half extents x, y, z, part
---@param given? table
---@return any
function World:drawInstances(given) end

---5 numbers a vertex: x, y, z, rgba, the handle of its shape or joint. Two vertices a line, three a triangle.
---@param given? table
---@return any
function World:drawLines(given) end

---Points: a vertex each.
---@param given? table
---@return any
function World:drawPoints(given) end

---Triangles: three vertices each, counterclockwise seen from outside.
---@param given? table
---@return any
function World:drawTriangles(given) end

---All bodies, in the order of creation.
---@return feather.Body[]
function World:getBodies() end

---Who fell asleep and who woke, in the last step and by calls before it, in the order of creation.
---@return table
function World:getBodyEvents() end

---All bodies, in the order of creation.
---@return integer[]
function World:getBodyIds() end

---lower x, y, z, upper x, y, z
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function World:getBounds() end

---Events of the last step, ordered by the creation of A, then B.
---@return any
function World:getContactEvents() end

---@return feather.Counters
function World:getCounters() end

---kinetic, potential
---@return number
---@return number
function World:getEnergy() end

---All or none.
---@param bodies feather.Body[]
---@return number[]
function World:getExactTransforms(bodies) end

---@return number
---@return number
---@return number
function World:getGravity() end

---64 bits over poses, velocities, contacts, joints and events, low word first.
---@return string
function World:getHash() end

---Stiffness of contacts and of joints in a step of dt.
---@param dt number
---@return number
---@return number
function World:getHertz(dt) end

---Impacts of the last step on shapes that ask for FE_SHAPE_EVENTS_HIT, faster than
---fe_world_tuning.hit_event_threshold.
---@return table
function World:getHitEvents() end

---angle or translation, and its rate: 2 numbers a joint
---@param joints feather.Joint[]
---@return number[]
function World:getJointCoordinates(joints) end

---A body of nil is the world.
---@return table
function World:getJointEvents() end

---force and torque: 6 numbers a joint
---@param joints feather.Joint[]
---@return number[]
function World:getJointReactions(joints) end

---All joints, in the order of creation.
---@return feather.Joint[]
function World:getJoints() end

---linear x, y, z, and angular x, y, z about a point
---@param x number
---@param y number
---@param z number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function World:getMomentum(x, y, z) end

---the bodies that the last step moved, and 7 numbers for each
---@return feather.Body[]
---@return number[]
function World:getMoved() end

---The number in this world's handles, 1..4095.
---@return integer
function World:getNumber() end

---@return feather.Profile
function World:getProfile() end

---The one it was made with, or its own.
---@return feather.Store
function World:getStore() end

---@return integer
function World:getSubsteps() end

---@return any
function World:getTag() end

---x, y, z relative to an origin, and the rotation: 7 numbers a body
---@param bodies feather.Body[]
---@param origin any
---@return number[]
function World:getTransforms(bodies, origin) end

---@return feather.Tuning
function World:getTuning() end

---What setUserData or newWorld's table gave; nil at first.
---@return any
function World:getUserData() end

---linear and angular: 6 numbers a body
---@param bodies feather.Body[]
---@return number[]
function World:getVelocities(bodies) end

---While ignored, two bodies never collide, whatever their layers and groups.
---@param a feather.Body|nil
---@param b feather.Body|nil
---@param ignore any
function World:ignoreCollision(a, b, ignore) end

---True after destroy().
---@return boolean
function World:isDestroyed() end

---1 while fe_world_ignore_collision keeps the two apart, else 0.
---@param a feather.Body|nil
---@param b feather.Body|nil
---@return boolean
function World:isIgnored(a, b) end

---The same, in the world's store.
---@param bytes string
---@return feather.Hull|feather.Mesh|feather.Heightfield|feather.Compound
function World:load(bytes) end

---@param given feather.BallJointOptions
---@return feather.Joint
function World:newBallJoint(given) end

---So many clones of this world, which stays the caller's: its bodies, shapes and joints name those of each of them. {
---workers = 1, pool = a pool, block = 0, simd = "auto" }: who steps them; worlds that a worker takes at once, 0 is
---chosen.
---@param count integer
---@param given? table
---@return feather.Batch
function World:newBatch(count, given) end

---A dynamic body whose shapes weigh less than 1e-9 kg together, or that has none, gets 1 kg and the inertia of a
---sphere of 1 m, until it gets a shape or a mass.
---@param given? feather.BodyOptions
---@return feather.Body
function World:newBody(given) end

---In the world's store, as Store:newCompound.
---@param parts any
---@return feather.Compound
function World:newCompound(parts) end

---@param given feather.ConfigurableJointOptions
---@return feather.Joint
function World:newConfigurableJoint(given) end

---@param given feather.DistanceJointOptions
---@return feather.Joint
function World:newDistanceJoint(given) end

---@param given feather.FixedJointOptions
---@return feather.Joint
function World:newFixedJoint(given) end

---In the world's store, as Store:newHeightfield.
---@param given? table
---@return feather.Heightfield
function World:newHeightfield(given) end

---@param given feather.HingeJointOptions
---@return feather.Joint
function World:newHingeJoint(given) end

---{ frames = 16, bytes = 0 }: how many are kept, and what they may hold together, 0 is as much as they need. It ends
---with close() or with its world.
---@param given? table
---@return feather.History
function World:newHistory(given) end

---In the world's store, as Store:newHull.
---@param given? table
---@return feather.Hull
function World:newHull(given) end

---In the world's store, as Store:newMesh.
---@param given? table
---@return feather.Mesh
function World:newMesh(given) end

---@param given feather.MotorJointOptions
---@return feather.Joint
function World:newMotorJoint(given) end

---{ assets = true, fine = false, last = false, keyframeSteps = 600, bufferBytes = 64 MB }: what its assets hold is in
---the recording; more traces, so that the first body that differs is named; a flight recorder of what fits into
---bufferBytes; steps between keyframes. It ends with close(), when it is lost, or with its world.
---@param given? table
---@return feather.Recorder
function World:newRecorder(given) end

---@param given feather.RopeJointOptions
---@return feather.Joint
function World:newRopeJoint(given) end

---@param given feather.SliderJointOptions
---@return feather.Joint
function World:newSliderJoint(given) end

---What the world is now. It stays when the world is gone, until close() or the collector ends it.
---@return feather.State
function World:newState() end

---@param given feather.WheelJointOptions
---@return feather.Joint
function World:newWheelJoint(given) end

---Rebalances the trees that serve the queries.
function World:optimize() end

---The bodies that a sphere, capsule, box, cylinder, cone or hull overlaps, in the order of creation: exactly those
---that a sweep from there would start inside of.
---@param form any
---@param place any
---@param given? feather.QueryFilter
---@return any
function World:overlap(form, place, given) end

---Does it overlap anything?
---@param form any
---@param place any
---@param given? feather.QueryFilter
---@return any
function World:overlapAny(form, place, given) end

---From one corner of a box to the other: what getBounds returns.
---@param lower_x number
---@param lower_y number
---@param lower_z number
---@param upper_x number
---@param upper_y number
---@param upper_z number
---@param given? feather.QueryFilter
---@return any
function World:overlapBounds(lower_x, lower_y, lower_z, upper_x, upper_y, upper_z, given) end

---A translation of the form by depth along dx, dy, dz parts the two.
---@param form any
---@param place any
---@param given? feather.QueryFilter
---@return any
function World:overlapShapes(form, place, given) end

---The first body on a segment.
---@param x number
---@param y number
---@param z number
---@param dx number
---@param dy number
---@param dz number
---@param given? feather.QueryFilter
---@return any
function World:rayCast(x, y, z, dx, dy, dz, given) end

---Every body on a segment, each once, at its first hit, ordered by fraction, then by creation.
---@param x number
---@param y number
---@param z number
---@param dx number
---@param dy number
---@param dz number
---@param given? feather.QueryFilter
---@return any
function World:rayCastAll(x, y, z, dx, dy, dz, given) end

---Is anything on the segment? Faster than the first hit: it stops at whatever it finds.
---@param x number
---@param y number
---@param z number
---@param dx number
---@param dy number
---@param dz number
---@param given? feather.QueryFilter
---@return any
function World:rayCastAny(x, y, z, dx, dy, dz, given) end

---Rays are 6 numbers each. Returns how many hit, and 16 numbers for each: see fe_hit.
---@param rays any
---@param given? feather.QueryFilter
---@return any
function World:rayCastMany(rays, given) end

---Writes a file while the world is updated, each 15 steps or, with fine = true, each one. close() writes the rest.
---The table is that of newRecorder without last.
---@param path string
---@param given? table
---@return any
function World:record(path, given) end

---Makes the world the saved one. Returns "foreign" when the string is from a library whose results differ: then it
---goes on, not bit for bit. Objects that are gone are forgotten, with their user data. { newNumber = true }: handles
---have this world's number, not that of the saved one. { base = string }: what a difference was saved against.
---@param bytes string
---@param given? table
---@return any
function World:restore(bytes, given) end

---A string; equal worlds have equal ones. { assets = true } writes what its hulls, meshes and heightfields hold, too:
---where it is loaded, none need be there. { base = string }, of a save without one: what differs from it alone.
---@param given? table
---@return string
function World:save(given) end

---beginContact, stayContact, endContact(bodyA, bodyB, shapeA, shapeB, isTrigger); hit(bodyA, bodyB, x, y, z, nx, ny,
---nz, speed, impulse, materialA, materialB); sleep(body), wake(body); jointBreak(joint, bodyA, bodyB)
---@param callbacks any
function World:setCallbacks(callbacks) end

---m/s2.
---@param x number
---@param y number
---@param z number
function World:setGravity(x, y, z) end

---fe_joint_set_motor_speed for many, rad/s or m/s: a float a joint.
---@param joints feather.Joint[]
---@param speeds any
function World:setJointMotorSpeeds(joints, speeds) end

---a number a joint, all or none
---@param joints feather.Joint[]
---@param targets any
function World:setJointTargets(joints, targets) end

---filter(bodyA, bodyB, shapeA, shapeB, bodyTagA, bodyTagB, shapeTagA, shapeTagB) returns true when the two may
---collide. The step calls it for new pairs of which one shape has pairFilter = true. A filter that fails counts as
---true.
---@param filter any
function World:setPairFilter(filter) end

---The world becomes what a state is of, in the time of a copy: that world, a clone of it, or one of the same store.
---Objects that are gone are forgotten, with their user data.
---@param state feather.State
function World:setState(state) end

---@param count integer
function World:setSubsteps(count) end

---@param tag any
function World:setTag(tag) end

---fe_body_set_transform for many, all or none.
---@param bodies feather.Body[]
---@param numbers any
function World:setTransforms(bodies, numbers) end

---Changes what the table names.
---@param given? feather.Tuning
function World:setTuning(given) end

---Any value of yours; getUserData returns it.
---@param value any
function World:setUserData(value) end

---Likewise.
---@param bodies feather.Body[]
---@param numbers any
function World:setVelocities(bodies, numbers) end

---The first body that a moving sphere, capsule, box, cylinder, cone or hull touches.
---@param ... any
---@return any
function World:sweep(...) end

---Every body that it touches on its motion, as if the others were not there; see fe_world_raycast_all.
---@param ... any
---@return any
function World:sweepAll(...) end

---Does it touch anything? Faster than the first hit: it stops at whatever it finds.
---@param ... any
---@return any
function World:sweepAny(...) end

---Paths are 10 numbers each: place, rotation, translation.
---@param form any
---@param paths any
---@param given? feather.QueryFilter
---@return any
function World:sweepMany(form, paths, given) end

---Steps, then calls what was set with setCallbacks. There everything is allowed, destroying bodies too. An error of
---the pair filter or of a callback is raised when all are done: the first one.
---@param dt number
---@return any
function World:update(dt) end

---A rigid body. As an end of a joint nil is the world itself.
---@class feather.Body
local Body = {}

---N m s.
---@param x number
---@param y number
---@param z number
function Body:applyAngularImpulse(x, y, z) end

---N, until the next step ends: at the centre of mass, or at a point of the world.
---@param x number
---@param y number
---@param z number
---@param px? number
---@param py? number
---@param pz? number
function Body:applyForce(x, y, z, px, py, pz) end

---N s: at the centre of mass, or at a point of the world.
---@param x number
---@param y number
---@param z number
---@param px? number
---@param py? number
---@param pz? number
function Body:applyImpulse(x, y, z, px, py, pz) end

---N m, world axes, during all of the next step only.
---@param x number
---@param y number
---@param z number
function Body:applyTorque(x, y, z) end

---The point of its surface that is closest to a place.
---@param x number
---@param y number
---@param z number
---@return any
function Body:closestPoint(x, y, z) end

---Destroys its shapes and joints too.
function Body:destroy() end

---@return number
---@return number
---@return number
function Body:getAngularVelocity() end

---The box around its shapes.
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function Body:getBounds() end

---Centre of mass, m, world space.
---@return number
---@return number
---@return number
function Body:getCentre() end

---What touches it.
---@return table[]
function Body:getContacts() end

---@return number
---@return number
function Body:getDamping() end

---@return integer
---@return integer
---@return integer
function Body:getFilter() end

---@return number
function Body:getGravityScale() end

---Those of a body, in the order of creation.
---@return feather.Joint[]
function Body:getJoints() end

---@return number
---@return number
---@return number
function Body:getLinearVelocity() end

---@return string
---@return string
function Body:getLocks() end

---kg; 0 for a body that is not dynamic.
---@return number
function Body:getMass() end

---What the solver uses.
---@return feather.MassData
function Body:getMassData() end

---Of the body's origin, m.
---@return number
---@return number
---@return number
function Body:getPosition() end

---x, y, z, w.
---@return number
---@return number
---@return number
---@return number
function Body:getRotation() end

---Its shapes in the order of creation.
---@return feather.Shape[]
function Body:getShapes() end

---@return number
function Body:getSleepThreshold() end

---@return integer
function Body:getTag() end

---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function Body:getTransform() end

---"static", "kinematic" or "dynamic".
---@return string
function Body:getType() end

---What setUserData or the table of options gave; nil at first.
---@return any
function Body:getUserData() end

---Of the material point that is now at `point`, m/s.
---@param x number
---@param y number
---@param z number
---@return any
function Body:getVelocityAt(x, y, z) end

---The world that it belongs to.
---@return feather.World
function Body:getWorld() end

---1 awake, 0 asleep; static bodies are never awake.
---@return boolean
function Body:isAwake() end

---@return boolean
function Body:isBullet() end

---True once it is destroyed, or its world.
---@return boolean
function Body:isDestroyed() end

---@return boolean
function Body:isEnabled() end

---@return boolean
function Body:isSleepAllowed() end

---Gives a kinematic body the velocities that bring it to `target` in `seconds`.
---@param transform any
---@param seconds number
---@return any
function Body:moveTo(transform, seconds) end

---A box, by half its edges, m.
---@param x number
---@param y number
---@param z number
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newBox(x, y, z, given) end

---A rod with round ends along local Y: half the height of its axis, and its radius, m.
---@param half_height any
---@param radius any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newCapsule(half_height, radius, given) end

---A shape of a compound: its parts are in the shape's frame.
---@param compound feather.Compound
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newCompound(compound, given) end

---A cone along local Y, its tip up: half its height, and the radius of its base, m.
---@param half_height any
---@param radius any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newCone(half_height, radius, given) end

---A cylinder along local Y: half its height, and its radius, m.
---@param half_height any
---@param radius any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newCylinder(half_height, radius, given) end

---A shape of a heightfield, on a static body: terrain in the shape's frame.
---@param field any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newHeightfield(field, given) end

---A shape of a hull; its points are in the shape's frame.
---@param hull feather.Hull
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newHull(hull, given) end

---A shape of a mesh, on a static or kinematic body; its vertices are in the shape's frame.
---@param mesh feather.Mesh
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newMesh(mesh, given) end

---The half space normal . p <= distance, on a static body.
---@param nx number
---@param ny number
---@param nz number
---@param distance number
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newPlane(nx, ny, nz, distance, given) end

---Mass and inertia of the body follow; it is not woken.
---@param form any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newShape(form, given) end

---A ball, by its radius, m.
---@param radius any
---@param given? feather.ShapeOptions
---@return feather.Shape
function Body:newSphere(radius, given) end

---Where a ray from a place along a vector meets it; nil where it does not.
---@param x number
---@param y number
---@param z number
---@param dx number
---@param dy number
---@param dz number
---@return any
function Body:rayCast(x, y, z, dx, dy, dz) end

---Mass and inertia from the shapes and their densities again.
---@return any
function Body:resetMass() end

---rad/s, world axes; otherwise as the linear velocity.
---@param x number
---@param y number
---@param z number
function Body:setAngularVelocity(x, y, z) end

---Waking a body wakes all that it touches, through other dynamic bodies.
---@param value any
function Body:setAwake(value) end

---See fe_body_def.
---@param value any
function Body:setBullet(value) end

---1/s, >= 0.
---@param linear number
---@param angular number
function Body:setDamping(linear, angular) end

---A disabled body keeps its place but neither moves, nor collides, nor is seen by queries.
---@param value any
function Body:setEnabled(value) end

---Layer, mask and group of all its shapes, see fe_shape_def.
---@param layer integer
---@param mask? integer
---@param group? integer
function Body:setFilter(layer, mask, group) end

---Factor of the world's gravity for this body; below 0 the body rises.
---@param scale number
function Body:setGravityScale(scale) end

---Of the centre of mass, m/s.
---@param x number
---@param y number
---@param z number
function Body:setLinearVelocity(x, y, z) end

---World axes along and about which the body cannot move, FE_AXIS_*: these coordinates stay bit for bit.
---@param linear any
---@param angular any
function Body:setLocks(linear, angular) end

---Sets the mass, kg, > 0, and scales the inertia with it.
---@param mass number
function Body:setMass(mass) end

---Overrides what the shapes give, until fe_body_reset_mass or a change of type.
---@param data any
function Body:setMassData(data) end

---Of its origin, m. Moves it at once, through whatever is between, and wakes it.
---@param x number
---@param y number
---@param z number
function Body:setPosition(x, y, z) end

---x, y, z, w, any length but zero. Turns it at once, and wakes it.
---@param x number
---@param y number
---@param z number
---@param w number
function Body:setRotation(x, y, z, w) end

---0 wakes the body and keeps all that it touches awake.
---@param value any
function Body:setSleepAllowed(value) end

---m/s, >= 0.
---@param speed number
function Body:setSleepThreshold(speed) end

---@param userData integer
function Body:setTag(userData) end

---Puts the body there at once, through whatever is between, and wakes it and what it touched.
---@param ... any
function Body:setTransform(...) end

---Its touching pairs send their exit and are found anew.
---@param text string
function Body:setType(text) end

---Any value of yours; getUserData returns it.
---@param value any
function Body:setUserData(value) end

---A form on a body, with material and filters.
---@class feather.Shape
local Shape = {}

---The point of its surface that is closest to a place.
---@param x number
---@param y number
---@param z number
---@return any
function Shape:closestPoint(x, y, z) end

---Its touching pairs send their exit.
function Shape:destroy() end

---The body that it belongs to.
---@return feather.Body
function Shape:getBody() end

---The box around it.
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function Shape:getBounds() end

---What touches it.
---@return table[]
function Shape:getContacts() end

---@return number
function Shape:getDensity() end

---@return integer
function Shape:getEvents() end

---@return integer
---@return integer
---@return integer
function Shape:getFilter() end

---@return any
function Shape:getForm() end

---@return table
function Shape:getFrame() end

---@return table
function Shape:getMaterial() end

---@return integer
---@return number
---@return number
---@return number
function Shape:getOneWay() end

---Shapes that touched it at the end of the last step, in the order of creation: who is inside a trigger now.
---@return feather.Shape
function Shape:getOverlaps() end

---@return integer
function Shape:getPairFilter() end

---@return number
---@return number
---@return number
function Shape:getSurfaceVelocity() end

---@return integer
function Shape:getTag() end

---What setUserData or the table of options gave; nil at first.
---@return any
function Shape:getUserData() end

---The world that it belongs to.
---@return feather.World
function Shape:getWorld() end

---True once it is destroyed, or its world.
---@return boolean
function Shape:isDestroyed() end

---@return boolean
function Shape:isTrigger() end

---Where a ray from a place along a vector meets it; nil where it does not.
---@param x number
---@param y number
---@param z number
---@param dx number
---@param dy number
---@param dz number
---@return any
function Shape:rayCast(x, y, z, dx, dy, dz) end

---kg/m3, >= 0.
---@param density number
function Shape:setDensity(density) end

---fe_shape_events, from the next step on.
---@param events any
function Shape:setEvents(events) end

---Takes effect at the next step.
---@param layer integer
---@param mask integer
---@param group integer
function Shape:setFilter(layer, mask, group) end

---Another form in the same place.
---@param form any
function Shape:setForm(form) end

---In the body's space.
---@param x number
---@param y number
---@param z number
---@param qx number
---@param qy number
---@param qz number
---@param qw number
function Shape:setFrame(x, y, z, qx, qy, qz, qw) end

---Changes what the table names.
---@param material any
function Shape:setMaterial(material) end

---The direction may be left out: it stays as it is.
---@param value any
---@param x number
---@param y number
---@param z number
function Shape:setOneWay(value, x, y, z) end

---Does the world's pair filter judge its pairs? Takes effect at the next step; its pairs are judged anew.
---@param value any
function Shape:setPairFilter(value) end

---m/s, shape frame, see fe_shape_def.
---@param x number
---@param y number
---@param z number
function Shape:setSurfaceVelocity(x, y, z) end

---@param userData integer
function Shape:setTag(userData) end

---A change ends its touching pairs, with their exit, and wakes the body.
---@param value any
function Shape:setTrigger(value) end

---Any value of yours; getUserData returns it.
---@param value any
function Shape:setUserData(value) end

---A joint of two bodies, or of one and the world.
---@class feather.Joint
local Joint = {}

---Its bodies wake.
function Joint:destroy() end

---@return any
function Joint:getAngle() end

---nil for the end that is the world
---@return feather.Body
---@return feather.Body
function Joint:getBodies() end

---What newBallJoint and its like were given, as it is now: a table of the same names.
---@return any
function Joint:getDefinition() end

---Where its frames are, world space.
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function Joint:getFrames() end

---What the joint did to B in the last step, on average: force at frame B's point, N, and torque about it, N m, world
---axes.
---@return number
---@return number
---@return number
---@return number
---@return number
---@return number
function Joint:getReaction() end

---@return feather.JointState
function Joint:getState() end

---@return integer
function Joint:getTag() end

---"distance", "ball", "hinge", "fixed" or "configurable".
---@return string
function Joint:getType() end

---What setUserData or the table of options gave; nil at first.
---@return any
function Joint:getUserData() end

---The world that it belongs to.
---@return feather.World
function Joint:getWorld() end

---True once it is destroyed, or its world.
---@return boolean
function Joint:isDestroyed() end

---@return boolean
function Joint:isEnabled() end

---Changes what the table names. A joint keeps its bodies.
---@param given? table
function Joint:set(given) end

---A disabled joint holds nothing, and its bodies may collide.
---@param value any
function Joint:setEnabled(value) end

---Speed of the motor alone; its cap stays.
---@param speed number
---@param dof any
function Joint:setMotorSpeed(speed, dof) end

---@param userData integer
function Joint:setTag(userData) end

---A ball joint's target is a rotation, x, y, z, w.
---@param target any
---@param dof any
---@param z number
---@param w number
function Joint:setTarget(target, dof, z, w) end

---Any value of yours; getUserData returns it.
---@param value any
function Joint:setUserData(value) end

---Assets that several worlds may share.
---@class feather.Store
local Store = {}

---Frees the store and all its assets.
function Store:destroy() end

---Memory of the store and its assets.
---@return any
function Store:getBytes() end

---True after destroy(); of a world's own store, after the world's.
---@return boolean
function Store:isDestroyed() end

---The heightfield, hull, mesh or compound of which save() made the string. Any string may be given: it is sound, or
---an error.
---@param bytes string
---@return any
function Store:load(bytes) end

---A table of parts, each a form with what else it has: { { "box", 1, 0.05, 0.6 }, { "sphere", 0.2, position = { 0, 1,
---0 }, rotation = { 0, 0, 0, 1 }, density = 500, material = { friction = 0.2 }, tag = 7 }... }. Density and material
---are the shape's where a part has none. The first part is 0, as hits tell it.
---@param parts any
---@return feather.Compound
function Store:newCompound(parts) end

---{ rows = , columns = , cellX = , cellZ = , heights = {...}, holes = {...}, cellMaterials = {...}, materials = { {
---friction = 0.8, userId = 3 }... } }
---@param given? table
---@return feather.Heightfield
function Store:newHeightfield(given) end

---{ points = { x, y, z... }, maxVertices = 64, tolerance = 0 }
---@param given? table
---@return feather.Hull
function Store:newHull(given) end

---{ vertices = { x, y, z... }, triangles = { a, b, c... }, twoSided = false, strict = false, weldDistance = 0,
---edgeAngle = 0.035, triangleMaterials = {...}, materials = { { friction = 0.8 }... }, triangleData = {...} } The
---first vertex is 0, and so is the first triangle, as hits tell it.
---@param given? table
---@return feather.Mesh
function Store:newMesh(given) end

---Worker threads that several worlds may share.
---@class feather.Pool
local Pool = {}

---Ends the threads.
function Pool:close() end

---A convex hull: an asset of a store.
---@class feather.Hull
local Hull = {}

---The handle dies at once, what it names with its last shape.
function Hull:destroy() end

---{ corners = { 0, 1, 2... }, normal = { x, y, z }, distance = } each: the first vertex is 0
---@return any
function Hull:getFaces() end

---@return feather.HullInfo
function Hull:getInfo() end

---What it is known by outside its store: equal where the content is.
---@return string
function Hull:getKey() end

---The store that it is in.
---@return feather.Store
function Hull:getStore() end

---{ x, y, z... }
---@return any
function Hull:getVertices() end

---True once it is destroyed, or its store.
---@return boolean
function Hull:isDestroyed() end

---As bytes, for store:load.
---@return string
function Hull:save() end

---Triangles of any form: an asset of a store.
---@class feather.Mesh
local Mesh = {}

---The handle dies at once, what it names with its last shape.
function Mesh:destroy() end

---@return feather.MeshInfo
function Mesh:getInfo() end

---What it is known by outside its store: equal where the content is.
---@return string
function Mesh:getKey() end

---The store that it is in.
---@return feather.Store
function Mesh:getStore() end

---{ corners = { x, y, z... }, edges = { { felt = , convex = , open = }... }, material = -1, data = 0 }; nil for one
---that was dropped
---@param number integer
---@return any
function Mesh:getTriangle(number) end

---True once it is destroyed, or its store.
---@return boolean
function Mesh:isDestroyed() end

---As bytes, for store:load.
---@return string
function Mesh:save() end

---As many as it has: what touches it wakes.
---@param materials any
function Mesh:setMaterials(materials) end

---Terrain: an asset of a store.
---@class feather.Heightfield
local Heightfield = {}

---The handle dies at once, what it names with its last shape.
function Heightfield:destroy() end

---@param row integer
---@param column integer
---@param rows integer
---@param columns integer
---@return any
function Heightfield:getHeights(row, column, rows, columns) end

---What it is known by outside its store: equal where the content is.
---@return string
function Heightfield:getKey() end

---The store that it is in.
---@return feather.Store
function Heightfield:getStore() end

---True once it is destroyed, or its store.
---@return boolean
function Heightfield:isDestroyed() end

---As bytes, for store:load.
---@return string
function Heightfield:save() end

---Changes the samples of a rectangle.
---@param row integer
---@param column integer
---@param rows integer
---@param columns integer
---@param heights any
function Heightfield:setHeights(row, column, rows, columns, heights) end

---A form of many parts: an asset of a store.
---@class feather.Compound
local Compound = {}

---The handle dies at once, what it names with its last shape.
function Compound:destroy() end

---@return feather.CompoundInfo
function Compound:getInfo() end

---What it is known by outside its store: equal where the content is.
---@return string
function Compound:getKey() end

---A part as newCompound takes it.
---@param number integer
---@return any
function Compound:getPart(number) end

---The store that it is in.
---@return feather.Store
function Compound:getStore() end

---True once it is destroyed, or its store.
---@return boolean
function Compound:isDestroyed() end

---As bytes, for store:load.
---@return string
function Compound:save() end

---The last frames of a world, to go back to.
---@class feather.History
local History = {}

---Ends it and gives its memory back.
function History:close() end

---{ frame = 3, bytes = 5000 } for each, the oldest first: its number, and what it holds that the one before has not.
---@return any
function History:getFrames() end

---The world as it is, under a number above the last one kept. The oldest go.
---@param frame integer
---@return any
function History:keep(frame) end

---Puts the world back; the frames behind go. Objects that are gone are forgotten, with their user data.
---@param frame integer
---@return any
function History:restore(frame) end

---A recording of a world while it grows, read as strings.
---@class feather.Recorder
local Recorder = {}

---What nobody read is lost. Closing again does nothing.
function Recorder:close() end

---Leaves words at this moment, about a body, a shape, a joint of the world, or nothing.
---@param text string
---@param about any
---@return any
function Recorder:note(text, about) end

---A string of what was recorded since the last read, to be appended to a file; "" when nothing waits. Of a flight
---recorder all that it keeps.
---@return any
function Recorder:read() end

---A recording of a world that goes to a file.
---@class feather.Recording
local Recording = {}

---World:update calls it: it writes what is new, now and then.
---@return any
function Recording:afterStep() end

---Writes the rest, and closes the file. An error as of flush. Closing again does nothing.
function Recording:close() end

---Writes all that was recorded until now. An error for what went wrong since it began.
---@return any
function Recording:flush() end

---Leaves words at this moment, about a body, a shape, a joint or nothing.
---@param text string
---@param about any
---@return any
function Recording:note(text, about) end

---A world that does what a recording says.
---@class feather.Player
local Player = {}

---Ends it, and its world unless that was released. Closing again does nothing.
function Player:close() end

---Adds bytes of a recording, in pieces of any size. An error for what is no recording or was altered: what stood
---before it plays.
---@param bytes string
---@return any
function Player:feed(bytes) end

---nil, or { type = "call", "step" or "keyframe", step, body, field, component, text }
---@return any
function Player:getDivergence() end

---{ step, firstStep, lastStep, calls, bytes, keyframes, notes, library, flags, foreign, hasDiverged }
---@return feather.PlayerInfo
function Player:getInfo() end

---{ step, about, text } of the words that were left in what it was fed: about is a handle, or 0.
---@return any
function Player:getNotes() end

---The world as it is now, to be read: what changes it is an error, and so is this before the first step.
---@return feather.World
function Player:getWorld() end

---Hands the world over: it may be changed and updated from here on, and outlives the player. A pair filter of the
---recorded world lets all pairs collide. A seek makes the player another world.
---@return any
function Player:release() end

---Goes to the end of a step, forwards or backwards, as getInfo counts them. false: the recording ends before it.
---Objects of what is not there at that step mean something else, or nothing: they are not to be kept.
---@param step integer
---@return any
function Player:seek(step) end

---Makes the recorded calls up to the end of the next step. false: there is no more yet. An error, once, when the
---world went another way: getDivergence tells, and the next call goes on.
---@return any
function Player:step() end

---for world in player:steps() do ... end: steps to the end.
---@return any
function Player:steps() end

---What a world was, for any world of the same store.
---@class feather.State
local State = {}

---Closing again does nothing.
function State:close() end

---Many worlds, made from one, that step together.
---@class feather.Batch
local Batch = {}

---Closing again does nothing.
function Batch:close() end

---world:getHash() of each.
---@return any
function Batch:getHashes() end

---The numbers of a field in a flat table, world by world, and then what the others return.
---@param name string
---@param items any
---@return any
function Batch:read(name, items) end

---Back to what the world was when the batch was made, or states[i] of each.
---@param mask any
---@param states any
---@return any
function Batch:reset(mask, states) end

---Each world as world:update does, so many steps (1); what was written acts in the first of them.
---@param dt number
---@param steps? integer
---@param mask? any
---@return any
function Batch:step(dt, steps, mask) end

---Numbers as of read, world by world, into a field.
---@param name string
---@param items any
---@param numbers any
---@param mask any
---@return any
function Batch:write(name, items, numbers, mask) end

---@class feather
---@field VERSION string
local feather = {}

---Worlds with different numbers refuse each other's handles.
---@param given? feather.WorldOptions
---@return feather.World
function feather.newWorld(given) end

---Starts a pool of workers that worlds can share (fe_world_def.pool).
---@param workers integer
---@return feather.Pool
function feather.newPool(workers) end

---{ number = 0 }, or nothing: its number is part of its assets' handles, 0 takes the next free one.
---@param given? table
---@return feather.Store
function feather.newStore(given) end

---{ file = "run.feather" } or { bytes = a string }, or feed() it; workers, simd, pool; store: where assets are found
---that the recording does not hold.
---@param given? table
---@return feather.Player
function feather.newPlayer(given) end

---A new world, made of a string and of newWorld's table, in which workers, pool, store, simd and userData count, and
---with newNumber = true the number; all else is the saved world's. Behind it "foreign", as of restore.
---@param bytes string
---@param given? feather.WorldOptions
---@return feather.World
function feather.loadWorld(bytes, given) end

---What a string is, after every check of a restore but for assets that are not in it; or an error.
---@param bytes string
---@return table
function feather.checkSnapshot(bytes) end

---The keys of the assets that it needs, as asset:getKey() has them.
---@param bytes string
---@return string[]
function feather.getSnapshotAssets(bytes) end

---Where two worlds first differ, of their strings: nil, or { kind, field, a, b, handle, other, index, element }, the
---values as texts. Elements and entries of lists count from 1.
---@param a string
---@param b string
---@return table|nil
function feather.compareSnapshots(a, b) end

return feather
