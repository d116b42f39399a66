"""The interface of the graph: every topic and every service, each defined here alone."""

from rclpy.qos import QoSProfile

from push_node.endpoints import GraphService, GraphTopic
from push_node.qos import COMMAND, EVENT, HISTORY, LATCHED, POSE, SCENE, STATE, TF

OBJECT_POSE = GraphTopic(
    'object_pose',
    'geometry_msgs/msg/PoseStamped',
    POSE,
    '100 Hz',
    ('sim_node',),
    'measured pose of the object; stamp = time of exposure',
    core=True,
)
PUSHER_POSE = GraphTopic(
    'pusher_pose',
    'geometry_msgs/msg/PoseStamped',
    POSE,
    '100 Hz',
    ('sim_node',),
    'measured position of the tip; stamp = time of exposure',
    core=True,
)
PUSHER_VELOCITY_CMD = GraphTopic(
    'pusher_velocity_cmd',
    'geometry_msgs/msg/TwistStamped',
    COMMAND,
    '100 Hz',
    ('mpc_node',),
    'velocity of the tip; stamp = that of the pose it answers',
    core=True,
)
NOMINAL_TRAJECTORY = GraphTopic(
    'nominal_trajectory',
    'push_msgs/msg/NominalTrajectory',
    LATCHED,
    'once per track',
    ('mpc_node',),
    'the timed reference',
    core=True,
)
CONTROLLER_STATE = GraphTopic(
    'controller_state',
    'push_msgs/msg/ControllerState',
    STATE,
    '100 Hz',
    ('mpc_node',),
    'inputs, result and timing of one control tick',
    core=True,
)
MODEL_INFO = GraphTopic(
    'model_info',
    'push_msgs/msg/ModelInfo',
    LATCHED,
    'once per model',
    ('gp_server',),
    'identity, hyperparameters and input range of the model',
    core=True,
)
ADDED_PUSHES = GraphTopic(
    'added_pushes',
    'push_msgs/msg/AddedPushes',
    HISTORY,
    'on event',
    ('gp_server',),
    'pushes that `push_gp/add_pushes` added to the model',
)
LESSON = GraphTopic(
    'lesson',
    'push_msgs/msg/Lesson',
    LATCHED,
    'once per lap',
    ('gp_server',),
    'what laps have taught: friction, support radius, shift of the reference; if it learns',
)
HORIZON = GraphTopic(
    'horizon',
    'push_msgs/msg/Horizon',
    STATE,
    '20 Hz',
    ('mpc_node',),
    'planned poses of the object over the horizon',
)
PERTURBATION = GraphTopic(
    'perturbation',
    'push_msgs/msg/Perturbation',
    EVENT,
    'on event',
    ('sim_node',),
    'a disturbance that the plant applied',
)
GROUND_TRUTH = GraphTopic(
    'push_sim/ground_truth',
    'push_msgs/msg/GroundTruth',
    STATE,
    '100 Hz',
    ('sim_node',),
    'true state of the plant at the exposure of the poses with the same stamp; for scores only',
)
RUN_END = GraphTopic(
    'run_end',
    'std_msgs/msg/String',
    LATCHED,
    'at the end',
    ('cell',),
    'why the run ended early; empty if it was completed',
)
SCENE_MARKERS = GraphTopic(
    'scene',
    'visualization_msgs/msg/MarkerArray',
    SCENE,
    '20 Hz',
    ('sim_node',),
    'object and tip for a viewer',
)
PLAN_MARKERS = GraphTopic(
    'plan_markers',
    'visualization_msgs/msg/MarkerArray',
    LATCHED,
    '20 Hz',
    ('markers',),
    'reference and horizon for RViz; `rviz:=true` starts the node',
)
DIAGNOSTICS = GraphTopic(
    '/diagnostics',
    'diagnostic_msgs/msg/DiagnosticArray',
    QoSProfile(depth=10),
    '1 Hz',
    ('sim_node', 'gp_server', 'mpc_node', 'recorder'),
    'health of each node',
)
PARAMETER_EVENTS = GraphTopic(
    '/parameter_events',
    'rcl_interfaces/msg/ParameterEvent',
    QoSProfile(depth=1000),
    'on event',
    ('sim_node', 'gp_server', 'mpc_node', 'recorder'),
    'changes of parameters; every node publishes them by itself',
)
TRANSFORMS = GraphTopic(
    '/tf',
    'tf2_msgs/msg/TFMessage',
    TF,
    '100 Hz',
    ('sim_node',),
    'frames `slider` and `pusher` in `world`',
)
CLOCK = GraphTopic(
    '/clock',
    'rosgraph_msgs/msg/Clock',
    QoSProfile(depth=10),
    'lockstep only',
    ('sim_node',),
    'simulated time',
)

TOPICS = (
    *(OBJECT_POSE, PUSHER_POSE, PUSHER_VELOCITY_CMD, NOMINAL_TRAJECTORY, CONTROLLER_STATE),
    *(MODEL_INFO, ADDED_PUSHES, LESSON, HORIZON, PERTURBATION, GROUND_TRUTH, RUN_END),
    *(SCENE_MARKERS, PLAN_MARKERS),
    *(DIAGNOSTICS, PARAMETER_EVENTS, TRANSFORMS, CLOCK),
)

RESET = GraphService(
    'push_sim/reset',
    'push_msgs/srv/Reset',
    'sim_node',
    'puts the plant into an exact state: at rest, command queue empty, random state from the seed',
)
RESET_TO_PLAN = GraphService(
    'push_sim/reset_to_plan',
    'std_srvs/srv/Trigger',
    'sim_node',
    'the same at the start of the newest `nominal_trajectory`, tip in contact; seed of the node',
)
PERTURB = GraphService(
    'push_sim/perturb',
    'push_msgs/srv/Perturb',
    'sim_node',
    'disturbs the object now',
)
PREDICT = GraphService(
    'push_gp/predict',
    'push_msgs/srv/Predict',
    'gp_server',
    'mean (n×3), variance (n×3) and Jacobian (n×3×2) of the motion for n inputs [p_y, β]',
)
ADD_PUSHES = GraphService(
    'push_gp/add_pushes',
    'push_msgs/srv/AddPushes',
    'gp_server',
    'extends the model by training pushes',
)
GET_MODEL = GraphService(
    'push_gp/get_model',
    'push_msgs/srv/GetModel',
    'gp_server',
    'the model file that the server loaded, for a recorder',
)
START = GraphService(
    'push_mpc/start',
    'std_srvs/srv/Trigger',
    'mpc_node',
    'starts a run; refused until model, solver, poses and recorder are ready',
)
STOP = GraphService(
    'push_mpc/stop',
    'std_srvs/srv/Trigger',
    'mpc_node',
    'stops the tip; latched until `push_mpc/resume`',
)
RESUME = GraphService(
    'push_mpc/resume',
    'std_srvs/srv/Trigger',
    'mpc_node',
    'releases a stop',
)

SERVICES = (RESET, RESET_TO_PLAN, PERTURB, PREDICT, ADD_PUSHES, GET_MODEL, START, STOP, RESUME)
