"""Launch a swarm, some of its robots, or one of them on its own computer."""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration

from .launched_nodes import folder_of, LaunchedNodes
from .robots import limits, RobotError

_SPACE = 'the namespace of the swarm'


def describe_swarm(swarm):
    """Describe a launch of a swarm, or of the robots that `members` names."""
    arguments = [
        ('namespace', swarm.name, _SPACE),
        ('members', '', 'the robots to launch, such as uav_1,uav_3; all when empty'),
        ('use_sim_time', 'false', 'whether time comes from the topic /clock'),
        ('world', 'false', 'whether a simulated world has the robots: swarmc simulate --ros2'),
        ('log_level', 'info', 'the least level of messages that are logged'),
        ('log_dir', '', 'folder for the logs of the nodes; that of ROS when empty'),
        ('trace_dir', '', 'folder for the trace of each node; none is written when empty'),
        ('respawn', 'false', 'whether a node that fails is started again, in its first state'),
        ('respawn_delay', '2.0', 'seconds until a node is started again'),
        ('other_models', 'warn', 'robots of another model: warn, refuse or ignore'),
    ]
    if swarm.monitor:
        about = 'whether the properties are watched, in a launch of the whole swarm'
        arguments.append(('monitor', 'true', about))
    if swarm.is_composed:
        arguments.append(('composed', 'true', 'whether the robots share a process'))
    if swarm.is_managed:
        about = 'whether the nodes configure and activate themselves'
        arguments.append(('autostart', 'true', about))
    if swarm.bringup:
        installed = 'true' if folder_of(swarm.bringup) else 'false'
        for name in ('functions', 'components'):
            about = f'whether {name} are launched, by package {swarm.bringup}'
            arguments.append((name, installed, about))
    if any(role.servers for role in swarm.roles.values()):
        about = f'whether nodes of {swarm.package} that have servers of functions are launched'
        arguments.append(('servers', 'true', about))
    for name, role in swarm.roles.items():
        about = f'how many of {name}: {limits(role)}; when empty {role.least}, or as many as named'
        arguments.append((f'{name}_count', '', about))
    launch = OpaqueFunction(function=lambda context: LaunchedNodes(swarm, context).groups())
    return LaunchDescription([*_declared(arguments), launch])


def describe_robot(package, swarms):
    """
    Describe a launch of the robot `member`, with all nodes that its computer has.

    `swarms` has the roles of each swarm by the name of its launch file, which has more arguments.
    """
    first = next(role for roles in swarms.values() for role in roles)
    arguments = [
        ('member', '', f'the robot of this computer, such as {first}_0'),
        ('swarm', '', f'its swarm, if several have such a robot: {", ".join(swarms)}'),
    ]
    launch = OpaqueFunction(function=lambda context: _one_robot(context, package, swarms))
    return LaunchDescription([*_declared(arguments), launch])


def _one_robot(context, package, swarms):
    member = LaunchConfiguration('member').perform(context).strip()
    named = LaunchConfiguration('swarm').perform(context)
    there = ', '.join(f'{role}_0' for roles in swarms.values() for role in roles)
    if not member or ',' in member or any(member in roles for roles in swarms.values()):
        raise RobotError(f'`member` names one robot, not `{member}`: {there} and so on')
    if named and named not in swarms:
        raise RobotError(f'there is no swarm {named}, but {", ".join(swarms)}')
    role = member.rpartition('[')[0] or member.rpartition('_')[0]
    having = [name for name, roles in swarms.items() if role in roles and named in ('', name)]
    if not having:
        raise RobotError(f'there is no robot {member}, but {there} and so on')
    if len(having) > 1:
        raise RobotError(f'several swarms have {role}: say which, swarm:={having[0]} for instance')
    path = str(Path(folder_of(package), 'launch', f'{having[0]}.launch.py'))
    source = PythonLaunchDescriptionSource(path)
    return [IncludeLaunchDescription(source, launch_arguments=[('members', member)])]


def _declared(arguments):
    return [
        DeclareLaunchArgument(name, default_value=value, description=description)
        for name, value, description in arguments
    ]
